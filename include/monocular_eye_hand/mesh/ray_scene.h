#pragma once
#include <Eigen/Core>
#include <memory>

#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

/// Ray queries against one mesh (Embree). Const calls are safe from several threads.
class RayScene {
 public:
  explicit RayScene(const Mesh& mesh);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  struct Hit {
    bool hit = false;
    double distance = 0;  ///< along the unit direction [m]
    int triangle = -1;
  };
  Hit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& unit_direction) const;
  /// True when something lies between the two points.
  bool occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace monocular_eye_hand
