#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/mesh/ray_tracer.h"

namespace monocular_eye_hand {

/// Rigid bodies for rays, built once and placed anew for every frame.
class InstanceWorld {
 public:
  explicit InstanceWorld(const std::vector<const Mesh*>& meshes);

  /// `seen[k]` false: body k casts shadows, but no camera ray meets it.
  void place(const std::vector<Rigid3>& world_from_body, const std::vector<bool>& seen);

  static constexpr int kLanes = RayTracer::kLanes;
  using Rays = RayTracer::Rays;
  using Hits = RayTracer::Hits;
  /// First hits of the lanes from t = near on: ids are bodies, normals are unit, world, towards the origin.
  void cast(const Rays& rays, float near, Hits* hits) const;
  /// blocked[k]: something lies on the ray before `far`; lanes that are not valid are not touched.
  void blocked(const Rays& rays, bool* blocked) const { all_.blocked(rays, blocked); }
  /// Interpolated over curved surfaces.
  Eigen::Vector3f smoothNormal(int body, unsigned triangle, float u, float v,
                               const Eigen::Vector3f& geometric) const;

 private:
  RayTracer all_{RayTracer::Kind::kMoving};
  RayTracer seen_{RayTracer::Kind::kMoving};
  std::vector<Eigen::Matrix3f> rotations_;
  std::vector<std::vector<Eigen::Vector3f>> corner_normals_;  // body frame
};

}  // namespace monocular_eye_hand
