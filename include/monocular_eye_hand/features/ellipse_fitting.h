#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// A contiguous run points[first .. first + count).
struct PointRange {
  int first = 0, count = 0;
};

struct EllipseFit {
  bool valid = false;
  Ellipse ellipse;
  Eigen::Matrix<double, 5, 5> covariance;  ///< of (centre u, centre v, a, b, angle) for independent points
  double chi2 = 0;                         ///< sum of squared distances over their variances
  double rms = 0;                          ///< [px]
  int count = 0;                           ///< points used
};

/// Direct least squares fit (Halir and Flusser 1998) to at most `max_points` of the points, evenly chosen.
EllipseFit fitEllipseDirect(const std::vector<EdgePoint>& points, const std::vector<PointRange>& ranges,
                            int max_points);

/// Gauss-Newton on the approximate distance F / |grad F| (Sampson 1982) with inverse variances and Tukey
/// weights, started from `start`. Blur moves the steepest point of a curved edge inwards by blur^2 / (2
/// radius of curvature); points are moved back by that amount.
EllipseFit refineEllipse(const std::vector<EdgePoint>& points, const std::vector<PointRange>& ranges,
                         const Ellipse& start, int max_points, int iterations);

/// Approximate signed distance (positive outside) and outward unit normal at a point.
struct EllipseDistance {
  double distance = 0;
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
};
EllipseDistance distanceTo(const Ellipse& ellipse, const Eigen::Vector2d& uv);
/// d distance / d (centre u, centre v, a, b, angle).
Eigen::Matrix<double, 1, 5> distanceJacobian(const Ellipse& ellipse, const Eigen::Vector2d& uv);
/// Eccentric angle of the direction in which a point lies [rad].
double eccentricAngle(const Ellipse& ellipse, const Eigen::Vector2d& uv);
/// Circumference (Ramanujan's second formula) [px].
double circumference(const Ellipse& ellipse);

}  // namespace monocular_eye_hand
