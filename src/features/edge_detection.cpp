#include "monocular_eye_hand/features/edge_detection.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/features/gradient.h"

namespace monocular_eye_hand {
namespace {

// Camera drivers and rectification leave dark lines along the image border.
constexpr int kBorder = 2;

struct Row {
  std::vector<float> dx, dy, magnitude;
  explicit Row(int cols) : dx(cols), dy(cols), magnitude(cols) {}
};

// Magnitudes one step back and ahead along the gradient, on the frame of the 3x3 neighbourhood: linear
// between the two pixels that the gradient passes between. The step is (1, t) or (t, 1).
struct Along {
  float behind, ahead;
  float step_x, step_y;
};
Along alongGradient(const float* above, const float* here, const float* below, int x, float gx, float gy) {
  const float ax = std::fabs(gx), ay = std::fabs(gy);
  if (ax >= ay) {
    const float t = gy / gx, w = std::fabs(t);
    const float *right = t >= 0 ? below : above, *left = t >= 0 ? above : below;
    const float plus = here[x + 1] + w * (right[x + 1] - here[x + 1]);
    const float minus = here[x - 1] + w * (left[x - 1] - here[x - 1]);
    return {minus, plus, 1.f, t};
  }
  const float t = gx / gy, w = std::fabs(t);
  const int side = t >= 0 ? 1 : -1;
  const float plus = below[x] + w * (below[x + side] - below[x]);
  const float minus = above[x] + w * (above[x - side] - above[x]);
  return {minus, plus, t, 1.f};
}

// Squared standard deviation of a Gaussian profile with centre m and samples one step away, in steps squared:
// x = 1 / (2 sigma^2) = -ln(1 - q), q = 1 - mean of the samples / m.
float profileVariance(float second_difference, float m) {
  const float q = std::min(0.9f, -second_difference / (2 * m));
  const float x = q * (1 + q * (0.5f + q * (1.f / 3 + q * 0.25f)));
  return 0.5f / std::max(x, 0.02f);
}

class PointFinder {
 public:
  PointFinder(EdgeMap* edges, float threshold, float difference_noise)
      : edges_(*edges), threshold_(threshold), difference_noise_(difference_noise) {}

  void scan(int y, const Row& above, const Row& here, const Row& below) {
    const float* m = here.magnitude.data();
    const int end = edges_.cols - kBorder;
    for (int x = kBorder; x < end; x += kRun) {
      const int stop = std::min(end, x + kRun);
      if (stop - x == kRun && !anyAbove(m + x)) continue;
      for (int k = x; k < stop; ++k)
        if (m[k] >= threshold_) test(k, y, above, here, below);
    }
  }

 private:
  static constexpr int kRun = 16;  // pixels looked at together

  bool anyAbove(const float* m) const {
    int any = 0;
    for (int k = 0; k < kRun; ++k) any |= m[k] >= threshold_;
    return any != 0;
  }

  void test(int x, int y, const Row& above, const Row& here, const Row& below) {
    const float m = here.magnitude[x], gx = here.dx[x], gy = here.dy[x];
    const Along along =
        alongGradient(above.magnitude.data(), here.magnitude.data(), below.magnitude.data(), x, gx, gy);
    if (!(m > along.behind && m >= along.ahead)) return;
    const float second = along.behind + along.ahead - 2 * m;
    const float delta =
        0.5f * (along.behind - along.ahead) / second;  // in steps along the axis of the larger part
    const float step2 = along.step_x * along.step_x + along.step_y * along.step_y;
    // The axis of the step points along +gradient only when the larger component is positive; delta is signed
    // along the axis, so it is right either way.
    EdgePoint p;
    p.uv = {float(x) + delta * along.step_x, float(y) + delta * along.step_y};
    p.normal = {gx / m, gy / m};
    p.gradient = m;
    p.sigma = difference_noise_ * std::sqrt(step2) / -second;
    p.blur = std::sqrt(profileVariance(second, m) * step2);
    edges_.index[size_t(y) * edges_.cols + x] = int32_t(edges_.points.size());
    edges_.points.push_back(p);
    edges_.x.push_back(int16_t(x));
    edges_.y.push_back(int16_t(y));
  }

  EdgeMap& edges_;
  const float threshold_, difference_noise_;
};

}  // namespace

EdgeMap detectEdgePoints(const cv::Mat& grey, const FeatureOptions& options) {
  const GradientKernel kernel = gradientKernel(options.smoothing_sigma);
  const double noise = imageNoise(grey);
  EdgeMap edges;
  edges.rows = grey.rows;
  edges.cols = grey.cols;
  edges.gradient_noise = noise * kernel.noise_gain;
  edges.threshold = std::max(options.gradient_threshold, options.noise_factor * edges.gradient_noise);
  edges.correlation_length = kernel.correlation_length;
  edges.index.assign(size_t(grey.rows) * grey.cols, -1);
  const size_t expected = edges.index.size() / 12;
  edges.points.reserve(expected);
  edges.x.reserve(expected);
  edges.y.reserve(expected);
  GradientRows gradients(grey, kernel);
  PointFinder finder(&edges, float(edges.threshold), float(noise * kernel.difference_gain));
  Row rows[3] = {Row(grey.cols), Row(grey.cols), Row(grey.cols)};
  for (int y = 0; y < grey.rows; ++y) {
    Row& next = rows[y % 3];
    gradients.compute(y, next.dx.data(), next.dy.data(), next.magnitude.data());
    if (y > kBorder && y < grey.rows - kBorder + 1)
      finder.scan(y - 1, rows[(y - 2) % 3], rows[(y - 1) % 3], next);
  }
  return edges;
}

}  // namespace monocular_eye_hand
