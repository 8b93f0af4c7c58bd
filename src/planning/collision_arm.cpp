#include "planning/collision_arm.h"

#include <cmath>
#include <random>
#include <set>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr int kSampledConfigurations = 64;  // that decide which links always touch

Solid solidOf(const ArmShape& shape) {
  switch (shape.kind) {
    case ArmShape::Kind::kBox:
      return boxSolid(shape.size, shape.link_from_shape);
    case ArmShape::Kind::kCylinder:
      return cylinderSolid(shape.size.x(), shape.size.z(), shape.link_from_shape);
    case ArmShape::Kind::kMesh:
      break;
  }
  return meshSolid(shape.mesh ? *shape.mesh : Mesh{}, shape.link_from_shape);
}

void enclose(CollisionLink* link) {
  if (link->solids.empty()) return;
  Eigen::AlignedBox3d bounds;
  for (const Solid& solid : link->solids) {
    const OrientedBox box = solid.boxAt({}, 0);
    const Eigen::Vector3d reach = box.axes.cwiseAbs() * box.half;
    bounds.extend(box.centre - reach);
    bounds.extend(box.centre + reach);
  }
  link->link_from_box.translation = bounds.center();
  link->half = bounds.sizes() / 2;
  link->radius = link->half.norm();
}

Rigid3 motion(const CollisionLink& link, const JointVector& joints, double gripper_width) {
  Rigid3 m;
  if (link.joint >= 0) m.rotation = Eigen::AngleAxisd(joints[link.joint], link.axis).toRotationMatrix();
  m.translation = link.axis * (link.finger * gripper_width);
  return m;
}

}  // namespace

CollisionArm::CollisionArm(const ArmDescription& arm)
    : tool0_(arm.link("tool0")), tool0_from_tcp_(arm.tool0_from_tcp), width_max_(arm.gripper_width_max) {
  for (const ArmLink& from : arm.links) {
    CollisionLink link;
    link.name = from.name;
    link.parent = from.parent;
    link.joint = from.joint;
    link.parent_from_joint = from.parent_from_joint;
    link.finger = from.finger;
    link.axis = from.axis;
    link.about_z = from.joint >= 0 && from.axis.isApprox(Eigen::Vector3d::UnitZ(), 1e-12);
    if (from.parent >= int(links_.size()) || from.joint > 5)
      throw BadInput("link " + from.name + ": parents come first and joints are 0 to 5");
    link.fixed = from.joint < 0 && from.finger == 0 && (from.parent < 0 || links_[from.parent].fixed);

    try {
      for (const ArmShape& shape : from.collision) link.solids.push_back(solidOf(shape));
    } catch (const BadInput& e) {
      throw BadInput("link " + from.name + ": " + e.what());
    }
    enclose(&link);
    links_.push_back(std::move(link));
  }

  findReach();
  findSelfPairs();
}

void CollisionArm::place(const JointVector& joints, double gripper_width, std::vector<Rigid3>* poses) const {
  poses->resize(links_.size());
  for (size_t i = 0; i < links_.size(); ++i) {
    const CollisionLink& link = links_[i];
    Rigid3& pose = (*poses)[i];
    if (link.parent < 0) {
      pose = link.parent_from_joint;
    } else {
      const Rigid3& parent = (*poses)[link.parent];
      pose.rotation.noalias() = parent.rotation * link.parent_from_joint.rotation;
      pose.translation.noalias() = parent.rotation * link.parent_from_joint.translation;
      pose.translation += parent.translation;
    }

    if (link.about_z) {
      const double c = std::cos(joints[link.joint]), s = std::sin(joints[link.joint]);
      const Eigen::Vector3d x = pose.rotation.col(0);
      pose.rotation.col(0) = c * x + s * pose.rotation.col(1);
      pose.rotation.col(1) = c * pose.rotation.col(1) - s * x;
    } else if (link.joint >= 0 || link.finger != 0) {
      pose = pose * motion(link, joints, gripper_width);
    }
  }
}

void CollisionArm::findReach() {
  for (size_t i = 0; i < links_.size(); ++i) {
    const double own =
        links_[i].solids.empty() ? 0 : links_[i].link_from_box.translation.norm() + links_[i].radius;
    double chain = 0;  // from the turning joint's origin to this link's
    for (int at = int(i); at >= 0; at = links_[at].parent) {
      const CollisionLink& link = links_[at];
      if (link.finger != 0) chain += std::abs(link.finger) * width_max_;
      if (link.joint >= 0) {
        reach_[link.joint] = std::max(reach_[link.joint], chain + own);
        if (int(i) == tool0_) tcp_reach_[link.joint] = chain + tool0_from_tcp_.translation.norm();
      }
      chain += link.parent_from_joint.translation.norm();
    }
  }
  for (int i = 0; i < 6; ++i) reach_[i] = std::max(reach_[i], tcp_reach_[i]);
}

void CollisionArm::findSelfPairs() {
  // What is rigidly connected is one body; what one joint connects are neighbours, and so are the fingers.
  std::vector<int> body(links_.size());
  std::set<std::pair<int, int>> neighbours;
  for (size_t i = 0; i < links_.size(); ++i) {
    const CollisionLink& link = links_[i];
    const bool moves = link.joint >= 0 || link.finger != 0;
    body[i] = link.parent < 0 || moves ? int(i) : body[link.parent];
    if (moves && link.parent >= 0) neighbours.insert({body[link.parent], body[i]});
  }

  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < int(links_.size()); ++i)
    for (int j = i + 1; j < int(links_.size()); ++j) {
      if (links_[i].solids.empty() || links_[j].solids.empty() || body[i] == body[j]) continue;
      if (neighbours.count({std::min(body[i], body[j]), std::max(body[i], body[j])})) continue;
      if (links_[i].finger != 0 && links_[j].finger != 0) continue;
      pairs.emplace_back(i, j);
    }

  std::vector<int> touching(pairs.size(), 0);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::vector<Rigid3> poses;
  for (int n = 0; n < kSampledConfigurations; ++n) {
    JointVector joints;
    for (int i = 0; i < 6; ++i) joints[i] = angle(random);
    place(joints, width_max_ * n / (kSampledConfigurations - 1), &poses);
    for (size_t k = 0; k < pairs.size(); ++k) {
      if (touching[k] != n) continue;
      const auto hit = [&] {
        for (const Solid& a : links_[pairs[k].first].solids)
          for (const Solid& b : links_[pairs[k].second].solids) {
            const Rigid3 &pa = poses[pairs[k].first], &pb = poses[pairs[k].second];
            if (overlap(a.boxAt(pa, 0), b.boxAt(pb, 0)) &&
                touch(a, pa * a.owner_from_solid, 0, b, pb * b.owner_from_solid))
              return true;
          }
        return false;
      };
      touching[k] += hit();
    }
  }

  for (size_t k = 0; k < pairs.size(); ++k)
    if (touching[k] < kSampledConfigurations) self_pairs_.push_back(pairs[k]);
}

}  // namespace monocular_eye_hand
