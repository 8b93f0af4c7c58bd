#include "features/arc_grid.h"

namespace monocular_eye_hand {

void ArcGrid::assign(const std::vector<EdgePoint>& points, const std::vector<EllipticArc>& arcs) {
  const auto middle = [&](const EllipticArc& a) { return points[a.first + a.count / 2].uv; };
  low_ = Eigen::Vector2f::Constant(1e9f);
  Eigen::Vector2f high = -low_;
  for (const EllipticArc& a : arcs) {
    low_ = low_.cwiseMin(middle(a));
    high = high.cwiseMax(middle(a));
  }
  if (arcs.empty()) return;
  cell_ = std::max(32.f, (high - low_).maxCoeff() / 64);
  cols_ = int((high.x() - low_.x()) / cell_) + 1;
  rows_ = int((high.y() - low_.y()) / cell_) + 1;
  // Counts become the ends of the cells; filling from behind turns them into the starts.
  starts_.assign(size_t(cols_) * rows_ + 1, 0);
  for (const EllipticArc& a : arcs) ++starts_[cellOf(middle(a))];
  for (size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
  arcs_.resize(arcs.size());
  for (int i = int(arcs.size()) - 1; i >= 0; --i) arcs_[--starts_[cellOf(middle(arcs[i]))]] = i;
}

}  // namespace monocular_eye_hand
