#pragma once
#include <Eigen/Core>

namespace monocular_eye_hand {

/// Turns the axes of an optical frame (z forward, y down) into those of its camera's body (x forward, z up).
inline Eigen::Matrix3d bodyFromOptical() {
  Eigen::Matrix3d rotation;
  rotation << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return rotation;
}

}  // namespace monocular_eye_hand
