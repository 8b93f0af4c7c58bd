#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/cell_gripper.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {
namespace {

std::vector<Eigen::Vector3d> fingerPoints(const ArmLink& link, const Rigid3& tcp_from_link) {
  std::vector<Eigen::Vector3d> points;
  for (const ArmShape& shape : link.collision)
    for (const Eigen::Vector3d& p : solidMesh(shape).vertices) points.push_back(tcp_from_link * p);
  return points;
}

}  // namespace

Mesh solidMesh(const ArmShape& shape) {
  Mesh mesh;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  if (shape.kind == ArmShape::Kind::kMesh) {
    if (!shape.mesh) throw BadInput("arm description: a mesh solid has no mesh");
    mesh = *shape.mesh;
  } else if (shape.kind == ArmShape::Kind::kBox) {
    mesh = boxMesh(shape.size);
    shift.z() = -shape.size.z() / 2;  // URDF solids are centred, these stand on their base
  } else {
    mesh = cylinderMesh(shape.size.x(), shape.size.z(), 48);
    shift.z() = -shape.size.z() / 2;
  }
  for (Eigen::Vector3d& p : mesh.vertices) p = shape.link_from_shape * (p + shift);
  return mesh;
}

GripperPads gripperPads(const ArmDescription& arm) {
  constexpr double kInPlane = 5e-4;
  const double width = arm.gripper_width_max;
  const std::vector<Rigid3> base_from_link = arm.baseFromLinks(JointVector::Zero(), width);
  const Rigid3 tcp_from_base = base_from_link[size_t(arm.link("gripper_tcp"))].inverse();
  GripperPads pads{1e9, -1e9, 1e9};
  bool found[2] = {false, false};
  for (size_t k = 0; k < arm.links.size(); ++k) {
    if (arm.links[k].finger == 0 || arm.links[k].collision.empty()) continue;
    const auto points = fingerPoints(arm.links[k], tcp_from_base * base_from_link[k]);
    double mean = 0, inner = 1e9;
    for (const Eigen::Vector3d& p : points) mean += p.y() / double(points.size());
    for (const Eigen::Vector3d& p : points) inner = std::min(inner, std::abs(p.y()));
    if (std::abs(inner - width / 2) > 1e-3)
      throw BadInput("arm description: the pad of " + arm.links[k].name + " is " + std::to_string(inner) +
                     " m from gripper_tcp at an opening of " + std::to_string(width) +
                     " m; it must be half the opening");
    double x = 0, low = 1e9, high = -1e9;
    for (const Eigen::Vector3d& p : points) {
      if (std::abs(p.y()) > inner + kInPlane) continue;
      x = std::max(x, std::abs(p.x())), low = std::min(low, p.z()), high = std::max(high, p.z());
    }
    pads = {std::min(pads.half_width, x), std::max(pads.z_low, low), std::min(pads.z_high, high)};
    found[mean > 0] = true;
  }
  if (!found[0] || !found[1] || !(pads.area() > 0) || !(pads.z_high > pads.z_low))
    throw BadInput(
        "arm description: two fingers with pads that face each other along y of gripper_tcp needed");
  return pads;
}

}  // namespace monocular_eye_hand
