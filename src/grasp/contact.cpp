#include "contact.h"

#include <cmath>

#include "monocular_eye_hand/mesh/ray_scene.h"

namespace monocular_eye_hand {
namespace {

constexpr int kAcross = 8, kAlong = 8;  // samples of a pad

Eigen::Vector3d normalOf(const Mesh& mesh, int triangle) {
  const auto& t = mesh.triangles[size_t(triangle)];
  const Eigen::Vector3d& a = mesh.vertices[size_t(t[0])];
  return (mesh.vertices[size_t(t[1])] - a).cross(mesh.vertices[size_t(t[2])] - a).normalized();
}

}  // namespace

PadContact padContact(const ObjectModel& model, const GripperOptions& gripper, const Rigid3& object_from_tcp,
                      double width) {
  const double cone = 1 / std::sqrt(1 + gripper.friction * gripper.friction);  // cosine of its half angle
  const double start = gripper.opening_max / 2 + gripper.compliance;
  int touching = 0;
  double cosines = 0;

  for (int i = 0; i < kAcross; ++i) {
    for (int k = 0; k < kAlong; ++k) {
      const double x = gripper.pad_width * ((i + 0.5) / kAcross - 0.5),
                   z = gripper.pad_length * ((k + 0.5) / kAlong - 0.5);
      double pair = 0;
      for (const double side : {1.0, -1.0}) {
        const Eigen::Vector3d inwards = object_from_tcp.rotation * Eigen::Vector3d(0, -side, 0);
        const RayScene::Hit hit =
            model.rays->cast(object_from_tcp * Eigen::Vector3d(x, side * start, z), inwards);
        if (!hit.hit || std::abs(start - hit.distance - width / 2) > gripper.compliance) break;
        const double cosine = -inwards.dot(normalOf(model.mesh, hit.triangle));
        if (cosine < cone) break;
        if (side < 0) {
          ++touching;
          cosines += (pair + cosine) / 2;
        }
        pair = cosine;
      }
    }
  }

  if (touching == 0) return {};
  return {double(touching) / (kAcross * kAlong), cosines / touching};
}

}  // namespace monocular_eye_hand
