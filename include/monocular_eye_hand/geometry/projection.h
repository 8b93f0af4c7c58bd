#pragma once
#include <Eigen/Core>

#include "monocular_eye_hand/geometry/camera.h"

namespace monocular_eye_hand {

constexpr int kIntrinsics = 12;  ///< fx, fy, cx, cy, d[0] to d[7]

/// Where the image as taken shows a point, with the derivatives that adjusting cameras and poses needs.
struct Projection {
  Eigen::Vector2d uv_raw;                ///< [px]
  Eigen::Matrix<double, 2, 3> by_point;  ///< by the point, camera frame [px/m]
  Eigen::Matrix<double, 2, kIntrinsics>
      by_intrinsics;  ///< by fx, fy, cx, cy, d; 0 of coefficients that the model lacks
};

/// Of a point before the camera (z > 0).
Projection projectWithDerivatives(const Camera& camera, const Eigen::Vector3d& p_in_camera);

}  // namespace monocular_eye_hand
