#include "features/line_fitting.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {

void LineSums::assign(const std::vector<EdgePoint>& points, int first, int count) {
  first_ = first;
  origin_ = points[first].uv.cast<double>();
  sums_.resize(size_t(count) + 1);
  Moments m;
  sums_[0] = m;
  for (int i = 0; i < count; ++i) {
    const EdgePoint& p = points[first + i];
    const double s = fitSigma(p), w = 1 / (s * s);
    const double x = p.uv.x() - origin_.x(), y = p.uv.y() - origin_.y();
    m.w += w;
    m.x += w * x;
    m.y += w * y;
    m.xx += w * x * x;
    m.xy += w * x * y;
    m.yy += w * y * y;
    sums_[size_t(i) + 1] = m;
  }
}

LineFit LineSums::fit(int begin, int end) const {
  const Moments m = between(begin, end);
  const double half = 0.5 * (m.xx - m.yy), root = std::sqrt(half * half + m.xy * m.xy);
  LineFit fit;
  fit.centre = origin_ + Eigen::Vector2d(m.x, m.y);
  // Of the two forms of the larger eigenvector the one in which nothing cancels.
  const Eigen::Vector2d along =
      half > 0 ? Eigen::Vector2d(root + half, m.xy) : Eigen::Vector2d(m.xy, root - half);
  const double length = along.norm();
  fit.direction = length > 0 ? Eigen::Vector2d(along / length) : Eigen::Vector2d(1, 0);
  fit.chi2 = std::max(0.0, 0.5 * (m.xx + m.yy) - root);
  fit.spread = 0.5 * (m.xx + m.yy) + root;
  fit.weight = m.w;
  return fit;
}

}  // namespace monocular_eye_hand
