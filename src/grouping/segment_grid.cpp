#include "grouping/segment_grid.h"

#include <algorithm>
#include <cmath>

#include "grouping/ends.h"

namespace monocular_eye_hand {
namespace {

// Half side of the window that local end density is counted in [px]: large enough to hold some ends of any
// texture that matters, small against the image.
constexpr double kDensityWindow = 40.0;

}  // namespace

SegmentGrid::SegmentGrid(const FeatureSet& features, double cell) : features_(features), cell_(cell) {
  columns_ = std::max(1, int(std::ceil(features.camera.width / cell)));
  rows_ = std::max(1, int(std::ceil(features.camera.height / cell)));
  ends_.resize(size_t(columns_) * rows_);
  segments_.resize(ends_.size());
  for (int s = 0; s < int(features.segments.size()); ++s) {
    const LineSegment& segment = features.segments[s];
    ends_[cellOf(segment.p)].push_back(2 * s);
    ends_[cellOf(segment.q)].push_back(2 * s + 1);
    const int steps = int(std::ceil(2.0 * segment.length() / cell)) + 1;
    for (int i = 0; i <= steps; ++i) {
      std::vector<int>& here = segments_[cellOf(segment.p + (segment.q - segment.p) * (double(i) / steps))];
      if (here.empty() || here.back() != s) here.push_back(s);
    }
  }
}

// Pixels outside the image (distortion taken out can put features there) fall into the cells of the border; a
// query is clamped in the same way and so still finds them.
int SegmentGrid::cellOf(const Eigen::Vector2d& uv) const {
  const int x = int(std::clamp(std::floor(uv.x() / cell_), 0.0, columns_ - 1.0));
  const int y = int(std::clamp(std::floor(uv.y() / cell_), 0.0, rows_ - 1.0));
  return y * columns_ + x;
}

SegmentGrid::Box SegmentGrid::box(const Eigen::Vector2d& uv, double radius) const {
  const int low = cellOf(uv - Eigen::Vector2d::Constant(radius));
  const int high = cellOf(uv + Eigen::Vector2d::Constant(radius));
  return {low % columns_, high % columns_, low / columns_, high / columns_};
}

void SegmentGrid::endsNear(const Eigen::Vector2d& uv, double radius, std::vector<int>* ends) const {
  ends->clear();
  const Box b = box(uv, radius);
  for (int y = b.y0; y <= b.y1; ++y)
    for (int x = b.x0; x <= b.x1; ++x)
      for (int end : ends_[size_t(y) * columns_ + x])
        if ((endPoint(features_, end) - uv).squaredNorm() <= radius * radius) ends->push_back(end);
  std::sort(ends->begin(), ends->end());
}

void SegmentGrid::segmentsNear(const Eigen::Vector2d& uv, double radius, std::vector<int>* segments) const {
  segments->clear();
  const Box b = box(uv, radius + 0.25 * cell_);  // a segment's cells are sampled every half cell
  for (int y = b.y0; y <= b.y1; ++y)
    for (int x = b.x0; x <= b.x1; ++x) {
      const std::vector<int>& here = segments_[size_t(y) * columns_ + x];
      segments->insert(segments->end(), here.begin(), here.end());
    }
  std::sort(segments->begin(), segments->end());
  segments->erase(std::unique(segments->begin(), segments->end()), segments->end());
}

double SegmentGrid::endDensity(const Eigen::Vector2d& uv, double own) const {
  const Box b = box(uv, kDensityWindow);
  int count = 0;
  for (int y = b.y0; y <= b.y1; ++y)
    for (int x = b.x0; x <= b.x1; ++x)
      for (int end : ends_[size_t(y) * columns_ + x]) count += !features_.segments[end / 2].joined();
  const double area = cell_ * cell_ * (b.x1 - b.x0 + 1) * (b.y1 - b.y0 + 1);
  // Half an end more than counted: an empty neighbourhood is no proof that accidents cannot happen.
  return (std::max(0.0, count - own) + 0.5) / area;
}

}  // namespace monocular_eye_hand
