#pragma once
#include <array>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/ellipse.h"
#include "monocular_eye_hand/geometry/rigid3.h"

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

/// A circle of an object and a point of it that is off the circle's axis (object frame, metres).
struct CircleAndPoint {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< any length, on the side that is seen
  double radius = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

struct CirclePointPose {
  Rigid3 camera_from_object;
  double error = 0;  ///< angle between the point's bearing and where this pose puts the point [rad]
};

/// Both poses that put the circle on `ellipse` (uv_rect), each turned about the circle's axis until the point
/// comes as near as it can to its image `uv` (rectified pixel); the one that brings it nearer first. With
/// equal errors, as of a circle seen head-on, in the order of circlePoses(). None when circlePoses() gives
/// none, the point is on the axis, or a number is not finite.
struct CirclePointPoses {
  int count = 0;
  std::array<CirclePointPose, 2> pose;
};
CirclePointPoses circlePointPoses(const Ellipse& ellipse, const Camera& camera, const CircleAndPoint& object,
                                  const Eigen::Vector2d& uv);

}  // namespace monocular_eye_hand
