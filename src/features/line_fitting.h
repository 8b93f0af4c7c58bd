#pragma once
#include <Eigen/Core>
#include <algorithm>
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
  /// Of that line.
  double chi2(int begin, int end) const {
    const Moments m = between(begin, end);
    const double half = 0.5 * (m.xx - m.yy);
    return std::max(0.0, 0.5 * (m.xx + m.yy) - std::sqrt(half * half + m.xy * m.xy));
  }
  double weight(int begin, int end) const {
    return sums_[size_t(end - first_)].w - sums_[size_t(begin - first_)].w;
  }

 private:
  struct Moments {
    double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  };
  // Weight, mean and central second moments.
  Moments between(int begin, int end) const {
    const Moments &a = sums_[size_t(begin - first_)], &b = sums_[size_t(end - first_)];
    Moments m{b.w - a.w, b.x - a.x, b.y - a.y, b.xx - a.xx, b.xy - a.xy, b.yy - a.yy};
    m.x /= m.w;
    m.y /= m.w;
    m.xx -= m.w * m.x * m.x;
    m.xy -= m.w * m.x * m.y;
    m.yy -= m.w * m.y * m.y;
    return m;
  }
  int first_ = 0;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<Moments> sums_;
};

}  // namespace monocular_eye_hand
