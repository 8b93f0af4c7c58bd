#pragma once
#include "monocular_eye_hand/mesh/ray_tracer.h"

namespace monocular_eye_hand {

/// Ray queries against one mesh, in its frame. Const calls are safe from several threads.
class RayScene {
 public:
  explicit RayScene(const Mesh& mesh);

  struct Hit {
    bool hit = false;
    double distance = 0;  ///< along the unit direction [m]
    int triangle = -1;
    bool from_behind = false;  ///< the triangle faces away from the ray
  };
  Hit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& unit_direction) const;
  /// Whether a point lies inside the mesh, which must be closed and its triangles turned outwards.
  bool inside(const Eigen::Vector3d& p) const;
  /// True when something lies between the two points.
  bool occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  Eigen::Vector3d centre_;  // single precision is finest near the origin
  RayTracer tracer_;
};

}  // namespace monocular_eye_hand
