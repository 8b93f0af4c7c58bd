#pragma once
#include <algorithm>
#include <limits>

#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// Height of an object's lowest vertex [m].
inline double lowest(const SceneObject& object) {
  double z = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : object.mesh->vertices) z = std::min(z, (object.world_from_object * p).z());
  return z;
}

}  // namespace monocular_eye_hand
