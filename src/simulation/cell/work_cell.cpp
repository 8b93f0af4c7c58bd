#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/seconds_text.h"
#include "monocular_eye_hand/mesh/stable_poses.h"
#include "monocular_eye_hand/simulation/cell/work_cell.h"
#include "simulation/cell/closing.h"
#include "simulation/cell/collision.h"
#include "simulation/cell/falling.h"
#include "simulation/scenes/settling.h"

namespace monocular_eye_hand {
namespace {

std::vector<std::string> labelsOf(const std::vector<SceneObject>& objects) {
  std::map<std::string, int> count;
  std::vector<std::string> labels;
  for (const SceneObject& object : objects)
    labels.push_back(fmt::format("{}_{}", object.name, count[object.name]++));
  return labels;
}

JointVector startOf(const CellOptions& options) { return JointVector(options.start_joints.data()); }

constexpr double kOutside = -1000;  // height of what was taken away: nothing meets it there [m]

int64_t nanoseconds(double seconds) { return int64_t(std::llround(seconds * 1e9)); }

}  // namespace

std::string toString(CellEvent::Kind kind) {
  switch (kind) {
    case CellEvent::Kind::kCollision:
      return "collision";
    case CellEvent::Kind::kLimit:
      return "limit";
    case CellEvent::Kind::kGrasped:
      return "grasped";
    case CellEvent::Kind::kSlipped:
      return "slipped";
    case CellEvent::Kind::kReleased:
      return "released";
    case CellEvent::Kind::kTakenAway:
      return "taken away";
    case CellEvent::Kind::kRested:
      break;
  }
  return "rested";
}

std::string textOf(const CellEvent& event) {
  std::string text = secondsText(event.time) + ": " + toString(event.kind) + ": " + event.first;
  if (!event.second.empty())
    text += (event.kind == CellEvent::Kind::kRested ? " on " : " with ") + event.second;
  return event.text.empty() ? text : text + ", " + event.text;
}

struct WorkCell::Impl {
  Impl(CellScene cell_scene, ArmDescription description, const Puma560Options& limits)
      : cell(std::move(cell_scene)),
        arm(std::move(description)),
        tcp_link(size_t(arm.link("gripper_tcp"))),
        camera_link(size_t(arm.link("camera_optical_frame"))),
        floor_z(-cell.base_from_table.translation.z()),
        motion(limits, startOf(cell.options)),
        gripper(gripperPads(arm), checkedWidth(cell.options.start_width), cell.options.gripper_speed,
                cell.options.friction, cell.options.pad_compliance),
        solids(arm, cell.scene.objects, cell.options.table.thickness, cell.scene.table, floor_z,
               cell.options.contact_tolerance),
        labels(labelsOf(cell.scene.objects)),
        table_from_base(cell.base_from_table.inverse()),
        falls(cell.scene.objects.size()),
        absent(cell.scene.objects.size(), false),
        taken_away(cell.scene.objects.size(), false),
        rests_on(cell.scene.objects.size(), kOnTable) {
    findSupports();
    placeArm();
    findCollisions();
  }

  double checkedWidth(double width) const {
    if (!(width >= 0 && width <= arm.gripper_width_max + 1e-9))
      throw BadInput(fmt::format("gripper width = {:.4f} m must be 0..{:.4f}", width, arm.gripper_width_max));
    return std::min(width, arm.gripper_width_max);
  }
  double time() const { return double(now) * 1e-9; }
  std::string nameOf(int id) const {
    if (id == kOnTable) return "table";
    return id == kOnFloor ? "floor" : labels[size_t(id)];
  }
  void record(CellEvent::Kind kind, const std::string& first, const std::string& second = "",
              const std::string& text = "") {
    events.push_back({kind, time(), first, second, text});
  }

  void findSupports();
  void placeArm();
  void step(double dt);
  bool moveArm(double dt);
  bool moveGripper(double dt);
  void carry();
  void letFall(int object);
  void leaveBehind(int support);
  void takeAway(int object);
  bool moveFalling();
  void findCollisions();
  std::vector<int> carriedCollisions();

  CellScene cell;
  ArmDescription arm;
  size_t tcp_link, camera_link;
  double floor_z;
  JointMotion motion;
  CellGripper gripper;
  CellSolids solids;
  std::vector<std::string> labels;
  Rigid3 table_from_base;
  std::vector<Rigid3> base_from_links;
  std::vector<std::unique_ptr<Fall>> falls;  // null: does not fall
  std::vector<bool> absent;                  // held, falling or taken away
  std::vector<bool> taken_away;
  std::vector<int> rests_on;
  std::vector<int> touched_at_grasp;  // what the held object stood against; until it is away from it
  std::set<std::pair<std::string, std::string>> in_collision;
  std::set<std::pair<int, int>> at_limit;
  std::vector<CellEvent> events;
  int64_t now = 0;
};

void WorkCell::Impl::findSupports() {
  const auto& objects = cell.scene.objects;
  for (size_t k = 0; k < objects.size(); ++k) {
    SceneObject lowered = objects[k];
    lowered.world_from_object.translation.z() -= 2 * cell.options.contact_tolerance;
    solids.placeObject(int(k), lowered.world_from_object);
    for (size_t other = 0; other < objects.size(); ++other)
      if (other != k &&
          objects[other].world_from_object.translation.z() < objects[k].world_from_object.translation.z() &&
          solids.meet(int(k), int(other)))
        rests_on[k] = int(other);
    solids.placeObject(int(k), objects[k].world_from_object);
  }
}

void WorkCell::Impl::placeArm() {
  base_from_links = arm.baseFromLinks(motion.positions(), gripper.width());
  std::vector<Rigid3> world_from_links;
  world_from_links.reserve(base_from_links.size());
  for (const Rigid3& base_from_link : base_from_links)
    world_from_links.push_back(table_from_base * base_from_link);
  solids.placeArm(world_from_links);
}

bool WorkCell::Impl::moveArm(double dt) {
  if (!motion.moving()) return false;
  const std::vector<LimitViolation> violations = motion.advance(dt);
  std::set<std::pair<int, int>> now_at_limit;
  for (const LimitViolation& v : violations) {
    const std::pair<int, int> key{v.joint, int(v.kind)};
    now_at_limit.insert(key);
    if (at_limit.count(key)) continue;
    const bool position = v.kind == LimitViolation::Kind::kPosition;
    record(CellEvent::Kind::kLimit, fmt::format("joint{}", v.joint + 1), "",
           position ? fmt::format("position {:.3f} rad, limit {:.3f}", v.wanted, v.limit)
                    : fmt::format("velocity {:.3f} rad/s, limit {:.3f}", v.wanted, v.limit));
  }
  at_limit.swap(now_at_limit);
  return true;
}

void WorkCell::Impl::carry() {
  const int held = gripper.held();
  if (held < 0) return;
  Rigid3& pose = cell.scene.objects[size_t(held)].world_from_object;
  const Rigid3 next = table_from_base * base_from_links[tcp_link] * gripper.tcpFromHeld();
  const bool moved =
      (next.translation - pose.translation).norm() > 1e-9 || (next.rotation - pose.rotation).norm() > 1e-9;
  pose = next;
  solids.placeObject(held, pose);
  if (moved) leaveBehind(held);
}

/// What stood on an object that is not there any more falls.
void WorkCell::Impl::leaveBehind(int support) {
  for (size_t k = 0; k < rests_on.size(); ++k)
    if (rests_on[k] == support && !absent[k]) letFall(int(k));
}

void WorkCell::Impl::takeAway(int object) {
  const size_t k = size_t(object);
  gripper.lose(object);
  falls[k].reset();
  absent[k] = taken_away[k] = true;
  cell.scene.objects[k].world_from_object.translation.z() = kOutside;
  solids.placeObject(object, cell.scene.objects[k].world_from_object);
  record(CellEvent::Kind::kTakenAway, labels[k]);
  leaveBehind(object);
}

bool WorkCell::Impl::moveGripper(double dt) {
  if (gripper.target() == gripper.width()) {
    gripper.step(0, {}, {});
    return false;
  }
  const double before = gripper.width();
  const Rigid3 world_from_tcp = table_from_base * base_from_links[tcp_link];
  const CellGripper::Outcome outcome =
      gripper.step(dt, world_from_tcp, {&cell.scene.objects, &cell.fixed, &absent, &solids});

  if (outcome.slipped >= 0)
    record(CellEvent::Kind::kSlipped, labels[size_t(outcome.slipped)], "", outcome.reason);
  if (outcome.jammed >= 0 &&
      in_collision.insert({labels[size_t(outcome.jammed)], nameOf(outcome.against)}).second)
    record(CellEvent::Kind::kCollision, labels[size_t(outcome.jammed)], nameOf(outcome.against),
           "pushed by a finger");

  if (outcome.grasped >= 0) {
    record(CellEvent::Kind::kGrasped, labels[size_t(outcome.grasped)]);
    absent[size_t(outcome.grasped)] = true;
    Rigid3 lowered = cell.scene.objects[size_t(outcome.grasped)].world_from_object;
    lowered.translation.z() -= 2 * cell.options.contact_tolerance;
    solids.placeObject(outcome.grasped, lowered);
    touched_at_grasp = solids.objectCollisions(outcome.grasped);
    solids.placeObject(outcome.grasped, cell.scene.objects[size_t(outcome.grasped)].world_from_object);
  }

  if (outcome.released >= 0) {
    record(CellEvent::Kind::kReleased, labels[size_t(outcome.released)]);
    letFall(outcome.released);
  }

  if (gripper.width() != before) placeArm();
  return gripper.width() != before || outcome.pushed;
}

void WorkCell::Impl::letFall(int object) {
  std::vector<const SceneObject*> others;
  for (size_t k = 0; k < cell.scene.objects.size(); ++k)
    others.push_back(int(k) == object || absent[k] ? nullptr : &cell.scene.objects[k]);
  const SceneObject& part = cell.scene.objects[size_t(object)];
  const Rest rest = settle(part, others, cell.scene.table, floor_z);
  rests_on[size_t(object)] = rest.on;
  absent[size_t(object)] = true;
  falls[size_t(object)] = std::make_unique<Fall>(*part.mesh, part.world_from_object, rest, time());
}

bool WorkCell::Impl::moveFalling() {
  bool moved = false;
  for (size_t k = 0; k < falls.size(); ++k) {
    if (!falls[k]) continue;
    moved = true;
    SceneObject& part = cell.scene.objects[k];
    part.world_from_object = falls[k]->at(time());
    solids.placeObject(int(k), part.world_from_object);
    if (time() < falls[k]->end()) continue;
    record(CellEvent::Kind::kRested, labels[k], nameOf(rests_on[k]));
    falls[k].reset();
    absent[k] = false;
  }
  return moved;
}

std::vector<int> WorkCell::Impl::carriedCollisions() {
  std::vector<int> met = solids.objectCollisions(gripper.held());
  const auto keep = [&](int id) { return std::count(met.begin(), met.end(), id) > 0; };
  touched_at_grasp.erase(std::remove_if(touched_at_grasp.begin(), touched_at_grasp.end(),
                                        [&](int id) { return id >= 0 && !keep(id); }),
                         touched_at_grasp.end());
  const auto from_start = [&](int id) {
    return id >= 0 && std::count(touched_at_grasp.begin(), touched_at_grasp.end(), id) > 0;
  };
  met.erase(std::remove_if(met.begin(), met.end(), from_start), met.end());
  return met;
}

void WorkCell::Impl::findCollisions() {
  std::set<std::pair<std::string, std::string>> pairs;
  for (const auto& [link, other] : solids.armCollisions(gripper.held()))
    pairs.insert({arm.links[size_t(link)].name, nameOf(other)});
  if (gripper.held() >= 0)
    for (int other : carriedCollisions()) pairs.insert({labels[size_t(gripper.held())], nameOf(other)});
  for (const auto& pair : pairs)
    if (!in_collision.count(pair)) record(CellEvent::Kind::kCollision, pair.first, pair.second);
  in_collision.swap(pairs);
}

void WorkCell::Impl::step(double dt) {
  const bool arm_moved = moveArm(dt);
  if (arm_moved) {
    placeArm();
    carry();
  }
  const bool gripper_moved = moveGripper(dt);
  const bool fell = moveFalling();
  if (arm_moved || gripper_moved || fell) findCollisions();
}

WorkCell::WorkCell(CellScene scene, ArmDescription arm, const Puma560Options& limits)
    : impl_(new Impl(std::move(scene), std::move(arm), limits)) {}
WorkCell::~WorkCell() = default;
WorkCell::WorkCell(WorkCell&&) noexcept = default;

void WorkCell::advance(double dt) {
  if (!(dt >= 0) || !std::isfinite(dt))
    throw BadInput(fmt::format("work cell: dt = {:g} s must be finite and not negative", dt));
  const int64_t end = impl_->now + nanoseconds(dt), step = nanoseconds(impl_->cell.options.step);
  while (impl_->now < end) {
    const int64_t next = std::min(end, (impl_->now / step + 1) * step);
    const double passed = double(next - impl_->now) * 1e-9;
    impl_->now = next;
    impl_->step(passed);
  }
}

double WorkCell::time() const { return impl_->time(); }
void WorkCell::commandArm(const std::vector<CellPathPoint>& path) { impl_->motion.command(path); }
void WorkCell::commandGripper(double width, double speed) {
  if (!std::isfinite(speed)) throw BadInput("gripper speed must be finite");
  impl_->gripper.command(impl_->checkedWidth(width), speed > 0 ? speed : impl_->cell.options.gripper_speed);
}
void WorkCell::takeAway(const std::string& label) {
  std::string there;
  for (size_t k = 0; k < impl_->labels.size(); ++k) {
    if (impl_->taken_away[k]) continue;
    if (impl_->labels[k] == label) return impl_->takeAway(int(k));
    there += (there.empty() ? "" : ", ") + impl_->labels[k];
  }
  throw BadInput("no object \"" + label + "\" is in the cell (" + there + ")");
}

bool WorkCell::takenAway(int object) const { return impl_->taken_away.at(size_t(object)); }

const JointVector& WorkCell::joints() const { return impl_->motion.positions(); }
const JointVector& WorkCell::velocities() const { return impl_->motion.velocities(); }
bool WorkCell::armMoving() const { return impl_->motion.moving(); }
double WorkCell::gripperWidth() const { return impl_->gripper.width(); }
double WorkCell::gripperVelocity() const { return impl_->gripper.velocity(); }
bool WorkCell::gripperMoving() const {
  return impl_->gripper.width() != impl_->gripper.target() && !impl_->gripper.stalled();
}
bool WorkCell::gripperStalled() const { return impl_->gripper.stalled(); }
int WorkCell::heldObject() const { return impl_->gripper.held(); }
const CellScene& WorkCell::scene() const { return impl_->cell; }
const ArmDescription& WorkCell::arm() const { return impl_->arm; }
std::vector<Rigid3> WorkCell::baseFromLinks() const { return impl_->base_from_links; }
Rigid3 WorkCell::baseFromTcp() const { return impl_->base_from_links[impl_->tcp_link]; }
Rigid3 WorkCell::baseFromCamera() const { return impl_->base_from_links[impl_->camera_link]; }
const std::string& WorkCell::label(int object) const { return impl_->labels.at(size_t(object)); }
const std::vector<CellEvent>& WorkCell::events() const { return impl_->events; }

int WorkCell::collisions() const {
  return int(std::count_if(impl_->events.begin(), impl_->events.end(),
                           [](const CellEvent& e) { return e.kind == CellEvent::Kind::kCollision; }));
}

std::vector<CellTruth> WorkCell::truth() const {
  std::vector<CellTruth> out;
  for (size_t k = 0; k < impl_->labels.size(); ++k) {
    const SceneObject& object = impl_->cell.scene.objects[k];
    out.push_back({impl_->labels[k], object.name, object.model, impl_->cell.baseFromObject(int(k)),
                   heldObject() == int(k), impl_->falls[k] != nullptr, impl_->taken_away[k]});
  }
  return out;
}

bool WorkCell::inDropZone(int object) const {
  if (impl_->absent.at(size_t(object))) return false;
  const SceneObject& part = impl_->cell.scene.objects[size_t(object)];
  const CellDropZone& zone = impl_->cell.options.drop_zone;
  const Eigen::Vector3d middle = part.world_from_object * centreOfMass(*part.mesh);
  return std::abs(middle.x() - zone.x) <= zone.length / 2 &&
         std::abs(middle.y() - zone.y) <= zone.width / 2 && middle.z() > 0;
}

}  // namespace monocular_eye_hand
