#pragma once
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "features/fit_points.h"
#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

struct EllipseFit {
  bool valid = false;
  Ellipse ellipse;
  /// Inverse covariance of (centre u, centre v, a, b, angle) for independent points.
  Eigen::Matrix<double, 5, 5> information = Eigen::Matrix<double, 5, 5>::Identity();
  double chi2 = 0;  ///< sum of squared distances over their variances
  double rms = 0;   ///< [px]
  int count = 0;    ///< points used
};

/// Direct least squares fit (Halir and Flusser 1998).
EllipseFit fitEllipseDirect(const FitPoints& points);

/// What a fit has to reach: one that does, and one whose next step does not promise to come near it, is not
/// finished.
struct FitGoal {
  double rms = std::numeric_limits<double>::infinity();  ///< [px]
  double chi2 = std::numeric_limits<double>::infinity();
};

/// Gauss-Newton on the approximate distance F / |grad F| (Sampson 1982) with inverse variances and Tukey
/// weights, started from `start`; a step that leads uphill is shortened. Blur moves the steepest point of a
/// curved edge inwards by blur^2 / (2 radius of curvature); points are moved back by that amount. A fit that
/// has reached `goal`, or has no hope for it, is returned as far as it came.
EllipseFit refineEllipse(const FitPoints& points, const Ellipse& start, int iterations,
                         const FitGoal& goal = {});

/// Covariance of (centre u, centre v, a, b, angle) [px, rad] of a valid refined fit, for independent points.
Eigen::Matrix<double, 5, 5> covarianceOf(const EllipseFit& fit);

/// Approximate signed distance (positive outside) and outward unit normal at a point.
struct EllipseDistance {
  double distance = 0;
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
};
/// An ellipse prepared for many points.
class EllipseFrame {
 public:
  explicit EllipseFrame(const Ellipse& ellipse)
      : e_(ellipse), cosine_(std::cos(ellipse.angle)), sine_(std::sin(ellipse.angle)) {}
  EllipseDistance distanceTo(const Eigen::Vector2d& uv) const;
  /// d distance / d (centre u, centre v, a, b, angle).
  Eigen::Matrix<double, 1, 5> distanceJacobian(const Eigen::Vector2d& uv) const;
  /// The point in the ellipse's axes in units of its semi-axes: on the unit circle for points of the ellipse.
  Eigen::Vector2d onUnitCircle(const Eigen::Vector2d& uv) const;
  /// Eccentric angle of the direction in which a point lies [rad].
  double eccentricAngle(const Eigen::Vector2d& uv) const;

 private:
  Ellipse e_;
  double cosine_, sine_;
};
inline EllipseDistance distanceTo(const Ellipse& ellipse, const Eigen::Vector2d& uv) {
  return EllipseFrame(ellipse).distanceTo(uv);
}
/// Circumference (Ramanujan's second formula) [px].
double circumference(const Ellipse& ellipse);

}  // namespace monocular_eye_hand
