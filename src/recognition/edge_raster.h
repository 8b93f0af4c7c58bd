#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "monocular_eye_hand/features/features.h"
#include "recognition/rect_domain.h"

namespace monocular_eye_hand {

/// Finds the edge point that a predicted contour sample most likely produced.
class EdgeRaster {
 public:
  EdgeRaster() = default;  ///< of no image: finds nothing
  /// The features may be moved while it is in use, but neither changed nor destroyed.
  EdgeRaster(const FeatureSet& features, const RectDomain& domain);

  /// Walks from `uv` along +/- `normal` (unit) up to `range` px; of the edge points whose direction agrees
  /// within about 25 degrees the one with the best mix of strength and nearness, or -1.
  int find(const Eigen::Vector2d& uv, const Eigen::Vector2d& normal, double range) const;
  const EdgePoint& point(int index) const { return points_[index]; }
  /// Index of an edge point in this pixel (map of one entry per pixel, thickened so that walks cannot slip
  /// through), or -1.
  int indexAt(int u, int v) const {
    const int x = u - u0_, y = v - v0_;
    if (unsigned(x) >= unsigned(width_) || unsigned(y) >= unsigned(height_)) return -1;
    return index_[size_t(y) * size_t(width_) + size_t(x)];
  }

  EdgeRaster(EdgeRaster&&) = default;
  EdgeRaster& operator=(EdgeRaster&&) = default;

 private:
  const EdgePoint* points_ = nullptr;
  int u0_ = 0, v0_ = 0, width_ = 0, height_ = 0;
  // Root of each point's gradient: the border of a shadow, though stronger, must not draw a contour off an
  // edge that lies beside it.
  std::vector<float> salience_;
  std::vector<int32_t> index_;
};

}  // namespace monocular_eye_hand
