#pragma once
#include <Eigen/Core>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// An object point that is seen somewhere on an image line: residual = normal . (project(p) - uv).
struct LineMatch {
  Eigen::Vector3d p_in_object;
  Eigen::Vector2d uv;      ///< rectified pixel on the line
  Eigen::Vector2d normal;  ///< unit
  double sigma = 1.0;      ///< standard deviation along the normal [px]
};

/// An object point seen at a pixel (two residuals).
struct PointMatch {
  Eigen::Vector3d p_in_object;
  Eigen::Vector2d uv;  ///< rectified pixel
  double sigma = 1.0;  ///< standard deviation per axis [px]
};

struct RefineOptions {
  int max_iterations = 15;
  double robust_scale = 3.0;  ///< Tukey cut-off in standard deviations; 0 = least squares
  double min_step = 1e-7;     ///< stop when the step is smaller [m, rad]

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("max_iterations", max_iterations);
    v("robust_scale", robust_scale);
    v("min_step", min_step);
  }
};

struct RefinedPose {
  Rigid3 camera_from_object;
  /// See perturbed(); scaled by the residuals' robust variance (by 1 when there is no redundancy). Directions
  /// that the matches leave open have the variance of a weak prior, 1 m and pi / sqrt(3) rad.
  Matrix6d covariance = Matrix6d::Zero();
  double rms = 0;      ///< weighted rms residual [px]
  double inliers = 0;  ///< sum of robust weights, one per match
  int iterations = 0;
  bool converged = false;
  bool well_posed = false;  ///< the normal equations have full rank (or full rank but for `free_axis`)
};

/// A rotation about `direction` (object frame) through `point` that cannot be seen.
struct FreeAxis {
  bool present = false;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), direction = Eigen::Vector3d::UnitZ();
};

}  // namespace monocular_eye_hand
