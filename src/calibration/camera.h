#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibration/view.h"
#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/projection.h"

namespace monocular_eye_hand {

struct CameraOptions {
  /// The lens, see setDistortion(); empty: the one of plumb_bob, rational_polynomial and equidistant that
  /// predicts views best that it was not fitted to.
  std::string model;
  bool free_warp = true;    ///< a flat target may be bent; where there are views enough to tell
  double robust_width = 3;  ///< of a point's error, beyond which it counts less [standard deviations]

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("model", model);
    v("free_warp", free_warp);
    v("robust_width", robust_width);
  }
};

struct CalibratedView {
  std::string name;
  Rigid3 camera_from_target;
  double rms = 0;           ///< of its points [px]
  double left_out_rms = 0;  ///< of its points with the camera of all other views [px]
};

struct CameraCalibration {
  Camera camera;
  /// Of fx, fy, cx, cy, d (see Projection), by the spread of the views; zeros where the model has no
  /// coefficient.
  Eigen::Matrix<double, kIntrinsics, kIntrinsics> covariance =
      Eigen::Matrix<double, kIntrinsics, kIntrinsics>::Zero();
  Eigen::Vector2d warp =
      Eigen::Vector2d::Zero();  ///< by which a flat target's middle stands up, along x and y [m]
  double rms = 0;               ///< of all points, per point [px]
  double left_out_rms = 0;      ///< the same of views that the camera was not fitted to [px]
  std::vector<CalibratedView> views;
};

/// Intrinsics and lens from views of a target, by Zhang's start and one adjustment of the camera, the poses
/// and the target's warp. Throws BadInput, naming what is wrong and what to do, with fewer than three views,
/// with a view of fewer than four points, and when the views leave the camera open (none tilted).
CameraCalibration calibrateCamera(const std::vector<CalibrationView>& views, int width, int height,
                                  const CameraOptions& options = {});

}  // namespace monocular_eye_hand
