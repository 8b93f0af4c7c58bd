#include "features/fit_points.h"

#include <algorithm>

#include "features/line_fitting.h"

namespace monocular_eye_hand {

void FitPoints::assign(const std::vector<EdgePoint>& points, const PointRange* ranges, size_t range_count,
                       int max_points) {
  int total = 0;
  for (size_t k = 0; k < range_count; ++k) total += ranges[k].count;
  const int stride = std::max(1, (total + max_points - 1) / max_points);

  count_ = 0;
  for (size_t k = 0; k < range_count; ++k)
    for (int i = (ranges[k].count % stride) / 2; i < ranges[k].count && count_ < kCapacity; i += stride) {
      const EdgePoint& p = points[size_t(ranges[k].first + i)];
      const size_t at = size_t(count_++);
      x_[at] = p.uv.x();
      y_[at] = p.uv.y();
      weight_[at] = 1 / fitVariance(p);
      blur2_[at] = double(p.blur) * p.blur;
    }

  for (int i = count_; count_ > 0 && i < padded(); ++i) {
    const size_t at = size_t(i), last = size_t(count_ - 1);
    x_[at] = x_[last];
    y_[at] = y_[last];
    weight_[at] = 0;
    blur2_[at] = blur2_[last];
  }
}

}  // namespace monocular_eye_hand
