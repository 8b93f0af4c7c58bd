#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/cell/gripper.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {
namespace {

/// A finger's face towards the other one: of its solids the largest in the plane y = +-half the opening.
struct FingerFace {
  GripperPads pad;
  double side = 0;     // sign of y
  double inner = 1e9;  // |y| of the nearest point
};

FingerFace fingerFace(const ArmLink& link, const Rigid3& tcp_from_link, double half_opening) {
  constexpr double kInPlane = 5e-4;
  FingerFace face;
  for (const ArmShape& shape : link.collision) {
    double x = 0, low = 1e9, high = -1e9;
    for (const Eigen::Vector3d& vertex : solidMesh(shape).vertices) {
      const Eigen::Vector3d p = tcp_from_link * vertex;
      if (std::abs(p.y()) < face.inner) {
        face.inner = std::abs(p.y());
        face.side = p.y() > 0 ? 1 : -1;
      }
      if (std::abs(std::abs(p.y()) - half_opening) > kInPlane) continue;
      x = std::max(x, std::abs(p.x()));
      low = std::min(low, p.z());
      high = std::max(high, p.z());
    }

    if (high > low && 2 * x * (high - low) > face.pad.area()) face.pad = {x, low, high};
  }
  return face;
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
  const double width = arm.gripper_width_max;
  const std::vector<Rigid3> base_from_link = arm.baseFromLinks(JointVector::Zero(), width);
  const Rigid3 tcp_from_base = base_from_link[size_t(arm.link("gripper_tcp"))].inverse();

  GripperPads pads{1e9, -1e9, 1e9};
  bool found[2] = {false, false};
  for (size_t k = 0; k < arm.links.size(); ++k) {
    if (arm.links[k].finger == 0 || arm.links[k].collision.empty()) continue;
    const FingerFace face = fingerFace(arm.links[k], tcp_from_base * base_from_link[k], width / 2);
    if (!(face.pad.area() > 0) || std::abs(face.inner - width / 2) > 1e-3)
      throw BadInput(
          fmt::format("arm description: {} is {:.4f} m from gripper_tcp at an opening of {:.4f} m; it must "
                      "have a flat pad at half the opening",
                      arm.links[k].name, face.inner, width));
    pads = {std::min(pads.half_width, face.pad.half_width), std::max(pads.z_low, face.pad.z_low),
            std::min(pads.z_high, face.pad.z_high)};
    found[face.side > 0] = true;
  }

  if (!found[0] || !found[1] || !(pads.z_high > pads.z_low))
    throw BadInput(
        "arm description: two fingers with pads that face each other along y of gripper_tcp needed");
  return pads;
}

}  // namespace monocular_eye_hand
