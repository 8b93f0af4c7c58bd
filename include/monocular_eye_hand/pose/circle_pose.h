#pragma once
#include <array>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/ellipse.h"

namespace monocular_eye_hand {

struct CirclePose {
  Eigen::Vector3d centre;  ///< camera frame [m]
  Eigen::Vector3d normal;  ///< unit, towards the camera (normal . centre < 0)
};

/// The two circles of `radius` [m] whose image is `ellipse` (uv_rect); equal when seen head-on. Both are
/// tilted by the same angle against their line of sight, so the image cannot rank them; the one that faces
/// further up in the image (normal.y smaller) comes first. None when the ellipse or the radius is not
/// positive and finite. Safaee-Rad et al., IEEE Trans. Robotics and Automation 8(5), 1992.
struct CirclePoses {
  int count = 0;
  std::array<CirclePose, 2> pose;
};
CirclePoses circlePoses(const Ellipse& ellipse, const Camera& camera, double radius);

}  // namespace monocular_eye_hand
