#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibration/view.h"
#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

enum class CameraMount {
  kInHand,  ///< the camera on the tool, the target fixed
  kFixed,   ///< the camera fixed, the target on the tool
};

struct HandEyeOptions {
  CameraMount mount = CameraMount::kInHand;
  double arm_sigma_translation = 1e-4;  ///< of a pose of the arm, per axis [m]
  double arm_sigma_rotation = 2e-4;     ///< per axis [rad]
  double focal_sigma = 0;               ///< of the given focal lengths, relative; 0: they are exact
  double scale_sigma = 1e-3;            ///< of the target's size, relative; 0: it is exact
  double robust_width = 3;  ///< of a point's error, beyond which it counts less [standard deviations]

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("arm_sigma_translation", arm_sigma_translation);
    v("arm_sigma_rotation", arm_sigma_rotation);
    v("focal_sigma", focal_sigma);
    v("scale_sigma", scale_sigma);
    v("robust_width", robust_width);
  }
};

/// What the arm and the image of a view leave unexplained.
struct HandEyeResidual {
  std::string name;
  double pixel_rms = 0;        ///< [px]
  double arm_translation = 0;  ///< by which the arm must have been elsewhere than told [m]
  double arm_rotation = 0;     ///< [rad]
};

struct HandEyeCalibration {
  /// Camera in the hand: tool_from_camera and base_from_target. Fixed: base_from_camera and tool_from_target.
  Rigid3 mount_from_camera, target;
  Camera camera;            ///< with the focal lengths adjusted, where they were not exact
  double target_scale = 1;  ///< true size of the target over the given one
  /// Of mount_from_camera (perturbed()'s d), then of the focal length's and the target's relative errors.
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Zero();
  std::string start;  ///< the closed form that led here
  double cost = 0;
  std::vector<HandEyeResidual> residuals;  ///< of the views, in their order
};

/// One problem of hand-eye, target, the arm's error at each view, focal length and target size, from every
/// closed form; the best of the adjusted ones is taken. Throws BadInput, naming what is wrong and what to do,
/// when there are fewer than three views or ones with fewer than four points, or the arm hardly turned or
/// about one axis only.
HandEyeCalibration calibrateHandEye(const std::vector<HandEyeView>& views, const Camera& camera,
                                    const HandEyeOptions& options = {});

}  // namespace monocular_eye_hand
