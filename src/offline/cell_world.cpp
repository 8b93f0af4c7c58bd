#include "offline/cell_world.h"

#include <algorithm>
#include <utility>

#include "monocular_eye_hand/geometry/error.h"
#include "offline/wall_clock.h"

namespace monocular_eye_hand {
namespace {

constexpr double kLongestFall = 5;  // [s]

/// Nobody stops an action here, and nobody watches it.
const ActionMonitor& unwatched() {
  static const ActionMonitor monitor{[] { return false; }, [](const std::string&, double) {},
                                     [](const std::vector<Trajectory>&) {}, [](const std::string&) {}};
  return monitor;
}

PickOrder orderOf(const PlannedGrasp& planned, int place) {
  PickOrder order;
  order.object = {planned.object.name, planned.object.number, planned.object.base_from_object};
  order.target.object = order.object.label();
  order.target.base_from_pregrasp = planned.grasp.base_from_pregrasp;
  order.target.base_from_grasp = planned.grasp.base_from_grasp;
  order.target.base_from_lift = planned.grasp.base_from_lift;
  order.target.opening = planned.grasp.opening;
  order.target.part_width = planned.grasp.part_width;
  order.place = place;
  return order;
}

std::vector<PlacedObject> placedObjects(const std::vector<MappedObject>& known) {
  std::vector<PlacedObject> objects;
  for (const MappedObject& object : known)
    objects.push_back({object.name, object.number, object.base_from_object});
  return objects;
}

}  // namespace

std::vector<TrueObject> trueObjects(const WorkCell& cell) {
  const std::vector<CellTruth> truth = cell.truth();
  std::vector<TrueObject> objects;
  for (size_t k = 0; k < truth.size(); ++k)
    if (!truth[k].taken_away)
      objects.push_back(
          {truth[k].label, truth[k].name, truth[k].base_from_object, truth[k].held, cell.inDropZone(int(k))});
  return objects;
}

CellWorld::CellWorld(WorkCell* cell, const Recognizer& recognizer, const Puma560& arm,
                     const GraspAdvisor& advisor, const OfflineOptions& options,
                     std::function<void(const CellLook&)> looked)
    : cell_(*cell),
      recognizer_(recognizer),
      advisor_(advisor),
      options_(options),
      task_arm_(options.task.arm),
      looked_(std::move(looked)),
      robot_(cell),
      executor_(options.executor, &robot_, &memory_),
      eyes_(*cell, recognizer, arm, options) {}

/// Runs an action of the executor with what is known now standing around the arm.
ActionResult CellWorld::act(const std::function<ActionResult()>& action) {
  const double begin = wallSeconds();
  if (eyes_.known().stamp) executor_.see(placedObjects(eyes_.known().objects));

  ActionResult result;
  try {
    result = action();
  } catch (const BadInput& e) {  // broken numbers; nothing moved then
    result.reason = e.what();
  }
  planning_ += result.planning_time;
  motion_ += wallSeconds() - begin - result.planning_time;
  return result;
}

std::optional<MappedObject> CellWorld::frame() const {
  const std::vector<MappedObject>& known = eyes_.known().objects;
  const auto found = std::find_if(known.begin(), known.end(), [&](const MappedObject& object) {
    return object.name == options_.task.clear_frame.frame;
  });
  return found == known.end() ? std::nullopt : std::optional<MappedObject>(*found);
}

ActionResult CellWorld::moveCamera(const TaskView& view) {
  const ArmDescription& arm = cell_.arm();
  const Eigen::Vector3d target = lookTarget(view, frame(), options_.task.centre, recognizer_.models());
  const std::vector<Rigid3> poses =
      cameraViews(view, target, task_arm_, arm.tool0_from_camera, cell_.joints(), options_.task.views);
  if (poses.empty()) {
    ActionResult nowhere{ActionOutcome::kUnreachable, ""};
    nowhere.reason = "no camera pose from which to look there is within the arm's reach";
    return nowhere;
  }

  MoveOrder order;
  const Rigid3 camera_from_tcp = arm.tool0_from_camera.inverse() * arm.tool0_from_tcp;
  for (const Rigid3& base_from_camera : poses)
    order.base_from_tcp.push_back(base_from_camera * camera_from_tcp);
  ActionResult moved = act([&] { return executor_.move(order, unwatched()); });
  if (!moved.done()) moved.reason = "the camera did not get there: " + moved.reason;
  return moved;
}

TaskLook CellWorld::look(const TaskView& view) {
  TaskLook look;
  const ActionResult moved = moveCamera(view);
  look.reason = moved.reason;
  if (!moved.done()) return look;

  robot_.rest(options_.task.settle);
  const AddedView added = eyes_.look(view, looked_);
  look.reason = added.report.refused;
  look.done = look.reason.empty();
  look.stamp = eyes_.known().stamp.value_or(0);
  look.objects = eyes_.known().objects;
  return look;
}

TaskGrasps CellWorld::graspTargets(const MappedObject& object) {
  const double begin = wallSeconds();
  const ArmNow arm{cell_.joints(), ""};
  const GraspAnswer answer =
      advisor_.answer(object.name, object.number, eyes_.known(), arm, options_.cell.table.pose.z);
  grasps_ += wallSeconds() - begin;

  TaskGrasps grasps;
  grasps.object = answer.index ? eyes_.known().objects[*answer.index] : object;
  grasps.plan.candidates = answer.candidates;
  grasps.plan.reason = answer.text;
  grasps.plan.too_uncertain = answer.status == GraspStatus::kTooUncertain;
  return grasps;
}

ActionResult CellWorld::pick(const PlannedGrasp& planned) {
  PickRecord record;
  record.name = planned.object.name;
  record.instance = planned.object.number;
  record.base_from_object = planned.object.base_from_object;
  record.base_from_grasp = planned.grasp.base_from_grasp;
  record.truth = trueObjects(cell_);

  record.result = act([&] { return executor_.pick(orderOf(planned, places_.next()), unwatched()); });
  picks_.push_back(record);
  return *record.result;
}

TaskGrip CellWorld::grip() { return gripOf(*robot_.state().gripper, options_.task.holding_width); }

ActionResult CellWorld::carry(const MappedObject& object, int part) {
  const int place = places_.of(part);
  const ActionResult placed = act([&] { return executor_.place(PlaceOrder{place}, unwatched()); });
  if (placed.done() || !grip().holding) places_.take(place);  // stopped after it let go: it may lie there
  if (placed.done()) eyes_.forget(object);
  return placed;
}

ActionResult CellWorld::open() {
  MoveOrder order;
  order.joints = {cell_.joints()};
  order.open_gripper = true;
  return act([&] { return executor_.move(order, unwatched()); });
}

bool CellWorld::falling() const {
  const std::vector<CellTruth> truth = cell_.truth();
  return std::any_of(truth.begin(), truth.end(), [](const CellTruth& object) { return object.falling; });
}

void CellWorld::settle() {
  const double begin = cell_.time();
  while (falling() && cell_.time() - begin < kLongestFall) robot_.rest(0);
}

ClearingTimes CellWorld::times() const {
  ClearingTimes times;
  times.rendering = eyes_.renderingSeconds();
  times.recognition = eyes_.recognitionSeconds();
  times.grasps = grasps_;
  times.planning = planning_;
  times.motion = motion_;
  return times;
}

}  // namespace monocular_eye_hand
