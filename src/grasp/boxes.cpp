#include "boxes.h"

#include <algorithm>

#include "monocular_eye_hand/model/interior.h"

namespace monocular_eye_hand {
namespace {

Eigen::AlignedBox3d box(double x0, double x1, double y0, double y1, double z0, double z1) {
  return {Eigen::Vector3d(x0, y0, z0), Eigen::Vector3d(x1, y1, z1)};
}

void addBothSides(const Eigen::AlignedBox3d& left, Boxes* boxes) {
  boxes->push_back(left);
  boxes->push_back(
      box(left.min().x(), left.max().x(), -left.max().y(), -left.min().y(), left.min().z(), left.max().z()));
}

void addBody(const GripperOptions& gripper, double approach, Boxes* boxes) {
  for (const GripperBox& b : gripper.body) {
    const Eigen::Vector3d centre(b.centre[0], b.centre[1], b.centre[2]),
        half = Eigen::Vector3d(b.size[0], b.size[1], b.size[2]) / 2;
    Eigen::AlignedBox3d swept(centre - half, centre + half);
    swept.min().z() -= approach;
    boxes->push_back(swept);
  }
}

}  // namespace

Boxes sweptBoxes(const GripperOptions& gripper, double opening, double width, double approach) {
  const double x = gripper.finger_width / 2, outside = opening / 2 + gripper.finger_thickness;
  Boxes boxes;
  addBothSides(box(-x, x, opening / 2, outside, -gripper.finger_length - approach, gripper.finger_tip),
               &boxes);
  // Closing: up to the pad's own give.
  addBothSides(
      box(-x, x, width / 2 + gripper.compliance, outside, -gripper.finger_length, gripper.finger_tip),
      &boxes);
  addBody(gripper, approach, &boxes);
  return boxes;
}

Boxes handBoxes(const GripperOptions& gripper, double opening) {
  const double x = gripper.finger_width / 2;
  Boxes boxes;
  addBothSides(box(-x, x, opening / 2, opening / 2 + gripper.finger_thickness, -gripper.finger_length,
                   gripper.finger_tip),
               &boxes);
  addBody(gripper, 0, &boxes);
  return boxes;
}

Boxes grown(const Boxes& boxes, const Eigen::Vector3d& by) {
  Boxes out = boxes;
  for (Eigen::AlignedBox3d& b : out) b = Eigen::AlignedBox3d(b.min() - by, b.max() + by);
  return out;
}

bool overlap(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
             const Eigen::Vector3d& c) {
  const Eigen::Vector3d half = box.sizes() / 2, middle = box.center();
  const Eigen::Vector3d v[3] = {a - middle, b - middle, c - middle};
  const auto separates = [&](const Eigen::Vector3d& axis) {
    const double p0 = axis.dot(v[0]), p1 = axis.dot(v[1]), p2 = axis.dot(v[2]);
    const double reach = half.dot(axis.cwiseAbs());
    return std::min({p0, p1, p2}) >= reach || std::max({p0, p1, p2}) <= -reach;
  };

  for (int k = 0; k < 3; ++k)
    if (separates(Eigen::Vector3d::Unit(k))) return false;

  const Eigen::Vector3d edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  const Eigen::Vector3d normal = edges[0].cross(edges[1]);
  if (normal.squaredNorm() > 0 && separates(normal)) return false;
  for (const Eigen::Vector3d& edge : edges) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = edge.cross(Eigen::Vector3d::Unit(k));
      if (axis.squaredNorm() > 1e-24 && separates(axis)) return false;
    }
  }
  return true;
}

MeshInHand::MeshInHand(const ObjectModel& model, const Rigid3& tcp_from_object)
    : model_(model), tcp_from_object_(tcp_from_object) {
  vertices_.reserve(model.mesh.vertices.size());
  for (const Eigen::Vector3d& v : model.mesh.vertices) {
    vertices_.push_back(tcp_from_object * v);
    bounds_.extend(vertices_.back());
  }
}

bool MeshInHand::inside(const Eigen::Vector3d& p_in_tcp) const {
  return bounds_.contains(p_in_tcp) && insideSolid(model_, tcp_from_object_.inverse() * p_in_tcp);
}

bool MeshInHand::meets(const Boxes& boxes) const {
  for (const Eigen::AlignedBox3d& box : boxes) {
    if (box.isEmpty() || !box.intersects(bounds_)) continue;
    for (const auto& t : model_.mesh.triangles)
      if (overlap(box, vertices_[size_t(t[0])], vertices_[size_t(t[1])], vertices_[size_t(t[2])]))
        return true;
    if (inside(box.center())) return true;
  }
  return false;
}

}  // namespace monocular_eye_hand
