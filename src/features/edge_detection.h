#pragma once
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// Which pixels hold an edge point, and which point: a bit per pixel and a count per word, because the points
/// lie in raster order.
class EdgePixels {
 public:
  void reset(int cols, int rows) {
    words_ = size_t(cols) / 32 + 2;
    runs_.assign(words_ * size_t(rows), {});
  }
  /// Pixels have to be added in raster order, as points 0, 1, 2 ...
  void add(int x, int y, int32_t point) {
    Run& run = runs_[word(x, y)];
    if (run.bits == 0) run.before = point;
    run.bits |= 1u << (x & 31);
  }
  /// Bit k tells whether pixel (x + k, y) holds a point, k = 0 .. count - 1; count up to 32.
  uint32_t run(int x, int y, int count) const {
    const size_t at = word(x, y);
    const uint64_t bits = runs_[at].bits | uint64_t(runs_[at + 1].bits) << 32;
    return uint32_t(bits >> (x & 31)) & uint32_t((1ull << count) - 1);
  }
  /// The point of a pixel that holds one.
  int32_t point(int x, int y) const {
    const Run& run = runs_[word(x, y)];
    return run.before + bitCount(run.bits & ((1u << (x & 31)) - 1));
  }

 private:
  size_t word(int x, int y) const { return size_t(y) * words_ + size_t(x >> 5); }
  static int bitCount(uint32_t v) {
    v -= (v >> 1) & 0x55555555u;
    v = (v & 0x33333333u) + ((v >> 2) & 0x33333333u);
    return int((((v + (v >> 4)) & 0x0F0F0F0Fu) * 0x01010101u) >> 24);
  }
  struct Run {  // 32 pixels of a row
    uint32_t bits = 0;
    int32_t before = 0;  // its first point
  };
  size_t words_ = 0;  // runs per row, one more than needed
  std::vector<Run> runs_;
};

/// Edge points of an image before linking, in raw pixels, in raster order, at least two pixels from the
/// border.
struct EdgeMap {
  std::vector<EdgePoint> points;
  std::vector<int16_t> x, y;  ///< the pixel each point belongs to
  EdgePixels pixels;
  int rows = 0, cols = 0;
  double gradient_noise = 0;      ///< standard deviation of a gradient component [grey levels per px]
  double threshold = 0;           ///< gradient threshold used
  double correlation_length = 1;  ///< of the noise along an edge [px]
};

/// Local maxima of the gradient magnitude along the gradient (Canny 1986), located by a parabola through the
/// magnitude one step before and after along the gradient.
class EdgeDetector {
 public:
  explicit EdgeDetector(const FeatureOptions& options);
  ~EdgeDetector();
  void detect(const cv::Mat& grey, EdgeMap* out);

 private:
  class Scan;
  std::unique_ptr<Scan> scan_;
};

}  // namespace monocular_eye_hand
