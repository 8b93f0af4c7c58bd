#pragma once
#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// Variance of an edge point as the fits use it: its own and what blur, rounding and real edges add.
inline double fitVariance(const EdgePoint& point) {
  constexpr double kModelError = 0.07;  // px
  return double(point.sigma) * point.sigma + kModelError * kModelError;
}
inline double fitSigma(const EdgePoint& point) { return std::sqrt(fitVariance(point)); }

/// Weighted total least squares line.
struct LineFit {
  Eigen::Vector2d centre;     ///< weighted mean of the points
  Eigen::Vector2d direction;  ///< unit; sign open
  double chi2 = 0;            ///< sum of squared distances over their variances
  double weight = 0;          ///< sum of inverse variances
  double spread = 0;          ///< weighted sum of squared distances along the line from the centre
  double rms() const { return weight > 0 ? std::sqrt(chi2 / weight) : 0; }
  double distance(const EdgePoint& point) const {
    return (point.uv.cast<double>() - centre).dot(Eigen::Vector2d(-direction.y(), direction.x()));
  }
};

/// Cumulated moments of a run of points: the line through any part of it in constant time.
class LineSums {
 public:
  /// Sums over points[first .. first + count).
  void assign(const std::vector<EdgePoint>& points, int first, int count);
  /// Line through points[begin .. end), indices as in the vector given to assign; at least two points.
  LineFit fit(int begin, int end) const;
  double chi2(int begin, int end) const;  ///< of that line

 private:
  struct Moments {
    double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  };
  Moments between(int begin, int end) const;
  int first_ = 0;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<Moments> sums_;
};

}  // namespace monocular_eye_hand
