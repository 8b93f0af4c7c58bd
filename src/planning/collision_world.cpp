#include "monocular_eye_hand/planning/collision_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "monocular_eye_hand/geometry/error.h"
#include "planning/collision_arm.h"

namespace monocular_eye_hand {
namespace {

struct WorldObject {
  std::string name;
  Rigid3 base_from_object;
  Solid solid;
  OrientedBox box;
};

double distanceToBox(const OrientedBox& box, const Eigen::Vector3d& p) {
  const Eigen::Vector3d local = box.axes.transpose() * (p - box.centre);
  return (local.cwiseAbs() - box.half).cwiseMax(0).norm();
}

Rigid3 requireFinite(const Rigid3& pose, const std::string& name) {
  if (!pose.isFinite()) throw BadInput(name + ": its pose is not finite");
  if (!(pose.rotation.transpose() * pose.rotation).isIdentity(1e-6) || pose.rotation.determinant() < 0)
    throw BadInput(name + ": its pose has no rotation matrix");
  return pose;
}

double requirePadding(double padding) {
  if (!(padding >= 0 && padding <= 1))
    throw BadInput(fmt::format("padding = {:g} must be 0 to 1 m", padding));
  return padding;
}

}  // namespace

struct CollisionWorld::Impl {
  std::shared_ptr<const CollisionArm> arm;
  std::vector<std::string> fingers;
  std::vector<WorldObject> objects;
  std::vector<std::vector<char>> allowed;  // links first, then objects
  int carried = -1;
  Rigid3 tcp_from_carried;
  double width = 0, padding = 0, carried_padding = 0;
  mutable std::vector<Rigid3> poses;  // scratch

  int linkCount() const { return int(arm->links().size()); }
  const std::string& nameOf(int owner) const {
    return owner < linkCount() ? arm->links()[owner].name : objects[owner - linkCount()].name;
  }
  int find(const std::string& name) const {
    for (int i = 0; i < linkCount() + int(objects.size()); ++i)
      if (nameOf(i) == name) return i;
    return -1;
  }
  int require(const std::string& name) const {
    const int owner = find(name);
    if (owner >= 0) return owner;
    std::string known;
    for (int i = 0; i < linkCount() + int(objects.size()); ++i) known += (i ? ", " : "") + nameOf(i);
    throw BadInput("there is no link or object \"" + name + "\"; there are " + known);
  }
  int requireObject(const std::string& name) const {
    const int owner = require(name);
    if (owner < linkCount()) throw BadInput(name + " is a link of the arm, not an object of the world");
    return owner - linkCount();
  }
  bool canTouch(int link) const { return arm->links()[link].finger != 0; }  // what is carried

  /// `make` returns the solid or throws BadInput.
  template <class Make>
  void add(const std::string& name, const Make& make, const Rigid3& base_from_object) {
    if (name.empty() || find(name) >= 0) throw BadInput("the name \"" + name + "\" is empty or in use");
    WorldObject object;
    object.name = name;
    object.base_from_object = requireFinite(base_from_object, name);
    try {
      object.solid = make();
    } catch (const BadInput& e) {
      throw BadInput(name + ": " + e.what());
    }
    object.box = object.solid.boxAt(base_from_object, 0);
    objects.push_back(std::move(object));
    for (auto& row : allowed) row.push_back(0);
    allowed.emplace_back(linkCount() + objects.size(), 0);
  }

  // A visitor gets (first owner, its solid and pose, padding, second owner, its solid and pose) of every pair
  // whose boxes overlap, and says whether to stop.
  template <class Visitor>
  bool eachPair(const JointVector& joints, double grow, Visitor&& visit) const {
    arm->place(joints, width, &poses);
    return linksAndWorld(grow, visit) || linksAndLinks(grow, visit) ||
           (carried >= 0 && carriedAndAll(grow, visit));
  }

  template <class Visitor>
  bool linkAndSolid(int i, double pad, double grow, int owner, const Solid& solid,
                    const Rigid3& base_from_solid, const OrientedBox& box, Visitor& visit) const {
    const CollisionLink& link = arm->links()[i];
    const double margin = pad + grow;
    if (distanceToBox(box, poses[i] * link.link_from_box.translation) > link.radius + margin) return false;
    if (!overlap(boxOf(link, poses[i], margin), box)) return false;
    for (const Solid& part : link.solids)
      if (overlap(part.boxAt(poses[i], margin), box) &&
          visit(i, part, poses[i] * part.owner_from_solid, pad, owner, solid, base_from_solid))
        return true;
    return false;
  }

  template <class Visitor>
  bool linksAndWorld(double grow, Visitor& visit) const {
    for (int i = linkCount() - 1; i >= 0; --i) {  // the hand is the likeliest to touch
      if (arm->links()[i].fixed || arm->links()[i].solids.empty()) continue;
      for (int k = 0; k < int(objects.size()); ++k) {
        if (k == carried || allowed[i][linkCount() + k]) continue;
        const WorldObject& object = objects[k];
        if (linkAndSolid(i, padding, grow, linkCount() + k, object.solid, object.base_from_object, object.box,
                         visit))
          return true;
      }
    }
    return false;
  }

  template <class Visitor>
  bool linksAndLinks(double grow, Visitor& visit) const {
    for (const auto& pair : arm->selfPairs()) {
      const auto [i, j] = pair;
      if (allowed[i][j]) continue;
      const CollisionLink &a = arm->links()[i], &b = arm->links()[j];
      const double reach = a.radius + b.radius + grow;
      const OrientedBox whole = boxOf(b, poses[j], grow);
      if ((poses[i] * a.link_from_box.translation - whole.centre).squaredNorm() > reach * reach) continue;
      if (!overlap(boxOf(a, poses[i], 0), whole)) continue;
      for (const Solid& part : b.solids) {
        const OrientedBox box = part.boxAt(poses[j], 0);
        if (linkAndSolid(i, 0, grow, j, part, poses[j] * part.owner_from_solid, box, visit)) return true;
      }
    }
    return false;
  }

  template <class Visitor>
  bool carriedAndAll(double grow, Visitor& visit) const {
    const WorldObject& held = objects[carried];
    const int owner = linkCount() + carried;
    const Rigid3 pose = arm->baseFromTcp(poses) * tcp_from_carried;
    const OrientedBox box = held.solid.boxAt(pose, 0),
                      bigger = held.solid.boxAt(pose, carried_padding + grow);
    for (int k = 0; k < int(objects.size()); ++k) {
      if (k == carried || allowed[owner][linkCount() + k] || !overlap(bigger, objects[k].box)) continue;
      if (visit(owner, held.solid, pose, carried_padding, linkCount() + k, objects[k].solid,
                objects[k].base_from_object))
        return true;
    }
    for (int i = 0; i < linkCount(); ++i)
      if (!arm->links()[i].solids.empty() && !canTouch(i) && !allowed[i][owner] &&
          linkAndSolid(i, 0, grow, owner, held.solid, pose, box, visit))
        return true;
    return false;
  }
};

CollisionWorld::CollisionWorld(const ArmDescription& arm) : impl_(std::make_unique<Impl>()) {
  if (arm.links.empty()) throw BadInput("the arm has no links");
  impl_->arm = std::make_shared<const CollisionArm>(arm);
  const int n = impl_->linkCount();
  impl_->allowed.assign(n, std::vector<char>(n, 0));
  for (const ArmLink& link : arm.links)
    if (link.finger != 0) impl_->fingers.push_back(link.name);
}
CollisionWorld::~CollisionWorld() = default;
CollisionWorld::CollisionWorld(const CollisionWorld& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
CollisionWorld& CollisionWorld::operator=(const CollisionWorld& other) {
  *impl_ = *other.impl_;
  return *this;
}

void CollisionWorld::addBox(const std::string& name, const Eigen::Vector3d& size,
                            const Rigid3& base_from_box) {
  impl_->add(
      name, [&] { return boxSolid(size); }, base_from_box);
}
void CollisionWorld::addMesh(const std::string& name, const Mesh& mesh, const Rigid3& base_from_mesh) {
  impl_->add(
      name, [&] { return meshSolid(mesh); }, base_from_mesh);
}
void CollisionWorld::remove(const std::string& name) {
  const int k = impl_->requireObject(name), row = impl_->linkCount() + k;
  impl_->objects.erase(impl_->objects.begin() + k);
  impl_->allowed.erase(impl_->allowed.begin() + row);
  for (auto& r : impl_->allowed) r.erase(r.begin() + row);
  if (impl_->carried == k) impl_->carried = -1;
  if (impl_->carried > k) --impl_->carried;
}
void CollisionWorld::move(const std::string& name, const Rigid3& base_from_object) {
  const int k = impl_->requireObject(name);
  if (k == impl_->carried) throw BadInput(name + " is carried and moves with the gripper");
  WorldObject& object = impl_->objects[k];
  object.base_from_object = requireFinite(base_from_object, name);
  object.box = object.solid.boxAt(base_from_object, 0);
}
Rigid3 CollisionWorld::pose(const std::string& name) const {
  const int k = impl_->requireObject(name);
  if (k == impl_->carried) throw BadInput(name + " is carried: its pose is that of the gripper");
  return impl_->objects[k].base_from_object;
}
bool CollisionWorld::has(const std::string& name) const { return impl_->find(name) >= impl_->linkCount(); }
std::vector<std::string> CollisionWorld::names() const {
  std::vector<std::string> names;
  for (const WorldObject& object : impl_->objects) names.push_back(object.name);
  return names;
}

void CollisionWorld::attach(const std::string& name, const Rigid3& tcp_from_object) {
  if (impl_->carried >= 0) throw BadInput("the gripper holds " + carried() + " already");
  impl_->carried = impl_->requireObject(name);
  impl_->tcp_from_carried = requireFinite(tcp_from_object, name);
}
void CollisionWorld::detach(const Rigid3& base_from_object) {
  if (impl_->carried < 0) throw BadInput("the gripper holds nothing that it could leave");
  const std::string name = carried();
  requireFinite(base_from_object, name);
  impl_->carried = -1;
  move(name, base_from_object);
}
const std::string& CollisionWorld::carried() const {
  static const std::string none;
  return impl_->carried < 0 ? none : impl_->objects[impl_->carried].name;
}

void CollisionWorld::setGripperWidth(double width) {
  if (!std::isfinite(width)) throw BadInput("the gripper's width is not finite");
  impl_->width = std::clamp(width, 0.0, impl_->arm->widthMax());
}
void CollisionWorld::setPadding(double padding) { impl_->padding = requirePadding(padding); }
double CollisionWorld::padding() const { return impl_->padding; }
void CollisionWorld::setCarriedPadding(double padding) { impl_->carried_padding = requirePadding(padding); }
double CollisionWorld::carriedPadding() const { return impl_->carried_padding; }

void CollisionWorld::allow(const std::string& a, const std::string& b) {
  const int i = impl_->require(a), j = impl_->require(b);
  impl_->allowed[i][j] = impl_->allowed[j][i] = 1;
}
void CollisionWorld::forbid(const std::string& a, const std::string& b) {
  const int i = impl_->require(a), j = impl_->require(b);
  impl_->allowed[i][j] = impl_->allowed[j][i] = 0;
}
bool CollisionWorld::allowed(const std::string& a, const std::string& b) const {
  return impl_->allowed[impl_->require(a)][impl_->require(b)] != 0;
}
const std::vector<std::string>& CollisionWorld::fingers() const { return impl_->fingers; }

bool CollisionWorld::valid(const JointVector& joints) const {
  if (!joints.allFinite()) return false;
  return !impl_->eachPair(joints, 0,
                          [](int, const Solid& a, const Rigid3& pose_a, double padding, int, const Solid& b,
                             const Rigid3& pose_b) { return touch(a, pose_a, padding, b, pose_b); });
}

CollisionPair CollisionWorld::firstCollision(const JointVector& joints) const {
  if (!joints.allFinite()) throw BadInput("the joints are not finite");
  CollisionPair pair;
  impl_->eachPair(joints, 0,
                  [&](int i, const Solid& a, const Rigid3& pose_a, double padding, int j, const Solid& b,
                      const Rigid3& pose_b) {
                    if (!touch(a, pose_a, padding, b, pose_b)) return false;
                    pair = {impl_->nameOf(i), impl_->nameOf(j), signedDistance(a, pose_a, b, pose_b)};
                    return true;
                  });
  return pair;
}

CollisionPair CollisionWorld::clearance(const JointVector& joints, double limit) const {
  if (!joints.allFinite()) throw BadInput("the joints are not finite");
  CollisionPair nearest;
  nearest.distance = limit;
  impl_->eachPair(
      joints, std::max(limit, 0.0),
      [&](int i, const Solid& a, const Rigid3& pose_a, double, int j, const Solid& b, const Rigid3& pose_b) {
        if (i < impl_->linkCount() && j < impl_->linkCount()) return false;
        const double distance = signedDistance(a, pose_a, b, pose_b);
        if (distance < nearest.distance) nearest = {impl_->nameOf(i), impl_->nameOf(j), distance};
        return false;
      });
  return nearest;
}

double CollisionWorld::motionBound(const JointVector& delta) const {
  double carried = 0, sum = 0;
  if (impl_->carried >= 0) {
    const Solid& solid = impl_->objects[impl_->carried].solid;
    carried =
        (impl_->tcp_from_carried * (solid.owner_from_solid * solid.box_centre)).norm() + solid.half.norm();
  }
  for (int i = 0; i < 6; ++i)
    sum += std::abs(delta[i]) * std::max(impl_->arm->reach()[i], impl_->arm->tcpReach()[i] + carried);
  return sum;
}

}  // namespace monocular_eye_hand
