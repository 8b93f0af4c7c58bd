#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// Edge points of an image before linking, in raw pixels, in raster order, at least two pixels from the
/// border.
struct EdgeMap {
  std::vector<EdgePoint> points;
  std::vector<int16_t> x, y;   ///< the pixel each point belongs to
  std::vector<int32_t> index;  ///< rows x cols: point of a pixel or -1
  int rows = 0, cols = 0;
  double gradient_noise = 0;      ///< standard deviation of a gradient component [grey levels per px]
  double threshold = 0;           ///< gradient threshold used
  double correlation_length = 1;  ///< of the noise along an edge [px]
};

/// Local maxima of the gradient magnitude along the gradient (Canny 1986), located by a parabola through the
/// magnitude one step before and after along the gradient.
EdgeMap detectEdgePoints(const cv::Mat& grey, const FeatureOptions& options);

}  // namespace monocular_eye_hand
