#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// A point of the calibration target and where an image shows it.
struct TargetPoint {
  Eigen::Vector3d p_in_target;  ///< as the target is drawn [m]
  Eigen::Vector2d uv_raw;       ///< in the image as taken
  double sigma = 0.1;           ///< standard deviation per axis [px]
};

/// One image of a calibration target.
struct CalibrationView {
  std::string name;  ///< of the image, for messages
  std::vector<TargetPoint> points;
};

/// The same with the pose of the arm at which it was taken.
struct HandEyeView : CalibrationView {
  Rigid3 base_from_tool;
};

}  // namespace monocular_eye_hand
