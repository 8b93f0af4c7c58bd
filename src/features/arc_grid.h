#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// Index of arcs by the cell of their middle point.
class ArcGrid {
 public:
  void assign(const std::vector<EdgePoint>& points, const std::vector<EllipticArc>& arcs);
  /// Calls use(arc) for the arcs of all cells that touch a box [px].
  template <class Use>
  void inBox(double u0, double v0, double u1, double v1, const Use& use) const {
    const auto cell = [&](double v, float low, int n) {
      return int(std::min(double(n - 1), std::max(0.0, std::floor((v - low) / cell_))));
    };
    const int x0 = cell(u0, low_.x(), cols_), x1 = cell(u1, low_.x(), cols_);
    const int y0 = cell(v0, low_.y(), rows_), y1 = cell(v1, low_.y(), rows_);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const size_t at = size_t(y) * cols_ + x;
        for (int k = starts_[at]; k < starts_[at + 1]; ++k) use(arcs_[k]);
      }
  }

 private:
  size_t cellOf(const Eigen::Vector2f& uv) const {
    return size_t((uv.y() - low_.y()) / cell_) * cols_ + size_t((uv.x() - low_.x()) / cell_);
  }
  Eigen::Vector2f low_ = Eigen::Vector2f::Zero();
  float cell_ = 32;  // side [px]
  int cols_ = 0, rows_ = 0;
  std::vector<int> starts_, arcs_;  // cell c holds arcs_[starts_[c] .. starts_[c + 1]), ascending
};

}  // namespace monocular_eye_hand
