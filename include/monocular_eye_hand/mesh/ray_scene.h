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
  };
  Hit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& unit_direction) const;
  /// True when something lies between the two points.
  bool occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  Eigen::Vector3d centre_;  // single precision is finest near the origin
  RayTracer tracer_;
};

}  // namespace monocular_eye_hand
