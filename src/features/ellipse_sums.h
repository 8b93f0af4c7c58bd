#pragma once
#include <Eigen/Core>

#include "features/fit_points.h"
#include "monocular_eye_hand/geometry/ellipse.h"

namespace monocular_eye_hand {

/// Scatter matrices of the direct fit (Halir and Flusser 1998) about the mean, in units of `scale`, of the
/// quadratic part (x^2, x y, y^2) and the linear part (x, y, 1).
struct ScatterMatrices {
  Eigen::Vector2d mean;  ///< [px]
  double scale = 0;      ///< root mean square distance from the mean [px]
  Eigen::Matrix3d quadratic, mixed, linear;
};
ScatterMatrices scatterMatrices(const FitPoints& points);

/// Gauss-Newton's matrix and right-hand side for (centre u, centre v, a, b, angle), with Tukey weights at
/// four standard deviations times `robust_scale`.
struct EllipseNormalEquations {
  Eigen::Matrix<double, 5, 5> h;
  Eigen::Matrix<double, 5, 1> g;
  double chi2 = 0;     ///< residuals over their variances, each at most (3 robust_scale)^2
  double squares = 0;  ///< plain sum of squared residuals [px^2]
};
EllipseNormalEquations normalEquations(const FitPoints& points, const Ellipse& ellipse, double robust_scale);

}  // namespace monocular_eye_hand
