#include "monocular_eye_hand/mesh/ray_scene.h"

#include <Eigen/Geometry>

namespace monocular_eye_hand {
namespace {

Eigen::Vector3d middleOf(const Mesh& mesh) {
  if (mesh.vertices.empty()) return Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  return box.center();
}

}  // namespace

RayScene::RayScene(const Mesh& mesh) : centre_(middleOf(mesh)), tracer_(RayTracer::Kind::kWatertight) {
  tracer_.add(mesh, {Eigen::Matrix3d::Identity(), -centre_});
  tracer_.commit();
}

RayScene::Hit RayScene::cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& unit_direction) const {
  const Eigen::Vector3f direction = unit_direction.cast<float>();
  const RayTracer::Hit hit = tracer_.cast((origin - centre_).cast<float>(), direction);
  if (hit.id == RayTracer::kNone) return {};
  return {true, double(hit.distance), int(hit.triangle), hit.normal.dot(direction) > 0};
}

bool RayScene::inside(const Eigen::Vector3d& p) const {
  // A direction that runs along no usual face; leaving the solid, the ray meets a face from behind.
  static const Eigen::Vector3d direction = Eigen::Vector3d(0.3819, 0.5402, 0.7499).normalized();
  return cast(p, direction).from_behind;
}

bool RayScene::occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  return tracer_.blocked((from - centre_).cast<float>(), (to - from).cast<float>(), 1);
}

}  // namespace monocular_eye_hand
