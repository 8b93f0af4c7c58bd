#include "features/edge_detection.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/features/gradient.h"
#include "monocular_eye_hand/geometry/vector_clones.h"

namespace monocular_eye_hand {
namespace {

// Camera drivers and rectification leave dark lines along the image border.
constexpr int kBorder = 2;

struct Row {
  std::vector<float> dx, dy, magnitude;
  void resize(int cols) {
    for (std::vector<float>* v : {&dx, &dy, &magnitude}) v->resize(size_t(cols));
  }
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

// The pixels of a row where the magnitude reaches the threshold and no step along the gradient finds more:
// alongGradient's comparison without its branches. Returns how many.
MONOCULAR_EYE_HAND_VECTOR_CLONES
int findMaxima(const float* above, const float* here, const float* below, const float* dx, const float* dy,
               float threshold, int begin, int end, int16_t* found) {
  constexpr int kRun = 16;  // pixels looked at together
  int count = 0;
  for (int from = begin; from < end; from += kRun) {
    // The last run overlaps the one before it, or counts nothing outside the row.
    const int x0 = std::max(begin, std::min(from, end - kRun)), n = std::min(kRun, end - x0);
    int any = 0;
    if (n == kRun)
      for (int k = 0; k < kRun; ++k) any |= here[x0 + k] >= threshold;
    if (n == kRun && !any) continue;

    uint8_t maximum[kRun] = {};
    const auto test = [&](int k) MONOCULAR_EYE_HAND_LAMBDA {
      const int x = x0 + k;
      const float m = here[x], gx = dx[x], gy = dy[x], ax = std::fabs(gx), ay = std::fabs(gy);
      const bool wide = ax >= ay, falling = (gx >= 0) == (gy >= 0);
      const float w = (wide ? ay : ax) / (wide ? ax : ay);
      const float straight_plus = wide ? here[x + 1] : below[x],
                  straight_minus = wide ? here[x - 1] : above[x];
      const float rising_plus = wide ? above[x + 1] : below[x - 1];
      const float rising_minus = wide ? below[x - 1] : above[x + 1];
      const float corner_plus = falling ? below[x + 1] : rising_plus;
      const float corner_minus = falling ? above[x - 1] : rising_minus;
      const float plus = straight_plus + w * (corner_plus - straight_plus);
      const float minus = straight_minus + w * (corner_minus - straight_minus);
      maximum[k] = (m >= threshold) & (m > minus) & (m >= plus);
    };
    if (n == kRun)
      for (int k = 0; k < kRun; ++k) test(k);
    else
      for (int k = 0; k < n; ++k) test(k);

    for (int k = from - x0; k < n; ++k) {
      found[count] = int16_t(x0 + k);
      count += maximum[k];
    }
  }
  return count;
}

// Squared standard deviation of a Gaussian profile with centre m and samples one step away, in steps squared:
// x = 1 / (2 sigma^2) = -ln(1 - q), q = 1 - mean of the samples / m.
float profileVariance(float second_difference, float m) {
  const float q = std::min(0.9f, -second_difference / (2 * m));
  const float x = q * (1 + q * (0.5f + q * (1.f / 3 + q * 0.25f)));
  return 0.5f / std::max(x, 0.02f);
}

}  // namespace

class EdgeDetector::Scan {
 public:
  explicit Scan(const FeatureOptions& options)
      : options_(options), kernel_(gradientKernel(options.smoothing_sigma)), gradients_(kernel_) {}

  void run(const cv::Mat& grey, EdgeMap* out) {
    edges_ = out;
    start(grey);
    gradients_.start(grey);
    for (int y = 0; y < grey.rows; ++y) {
      Row& next = rows_[y % 3];
      gradients_.compute(y, next.dx.data(), next.dy.data(), next.magnitude.data());
      if (y > kBorder && y < grey.rows - kBorder + 1)
        scan(y - 1, rows_[(y - 2) % 3], rows_[(y - 1) % 3], next);
    }
  }

 private:
  void start(const cv::Mat& grey) {
    const double noise = imageNoise(grey);
    EdgeMap& edges = *edges_;
    edges.rows = grey.rows;
    edges.cols = grey.cols;
    edges.gradient_noise = noise * kernel_.noise_gain;
    edges.threshold = std::max(options_.gradient_threshold, options_.noise_factor * edges.gradient_noise);
    edges.correlation_length = kernel_.correlation_length;
    difference_noise_ = float(noise * kernel_.difference_gain);

    edges.pixels.reset(grey.cols, grey.rows);
    const size_t expected = grey.total() / 4;  // what is not written costs nothing
    edges.points.clear();
    edges.points.reserve(expected);
    for (std::vector<int16_t>* v : {&edges.x, &edges.y}) {
      v->clear();
      v->reserve(expected);
    }
    found_.resize(size_t(grey.cols) + 1);
    for (Row& row : rows_) row.resize(grey.cols);
  }

  void scan(int y, const Row& above, const Row& here, const Row& below) {
    const int n =
        findMaxima(above.magnitude.data(), here.magnitude.data(), below.magnitude.data(), here.dx.data(),
                   here.dy.data(), float(edges_->threshold), kBorder, edges_->cols - kBorder, found_.data());
    for (int k = 0; k < n; ++k) add(found_[size_t(k)], y, above, here, below);
  }

  void add(int x, int y, const Row& above, const Row& here, const Row& below) {
    const float m = here.magnitude[x], gx = here.dx[x], gy = here.dy[x];
    const Along along =
        alongGradient(above.magnitude.data(), here.magnitude.data(), below.magnitude.data(), x, gx, gy);
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

    edges_->pixels.add(x, y, int32_t(edges_->points.size()));
    edges_->points.push_back(p);
    edges_->x.push_back(int16_t(x));
    edges_->y.push_back(int16_t(y));
  }

  const FeatureOptions options_;
  const GradientKernel kernel_;
  GradientRows gradients_;
  Row rows_[3];
  std::vector<int16_t> found_;  // pixels of a row
  EdgeMap* edges_ = nullptr;
  float difference_noise_ = 0;  // of half a difference of two magnitudes [grey levels per px]
};

EdgeDetector::EdgeDetector(const FeatureOptions& options) : scan_(std::make_unique<Scan>(options)) {}
EdgeDetector::~EdgeDetector() = default;
void EdgeDetector::detect(const cv::Mat& grey, EdgeMap* out) { scan_->run(grey, out); }

}  // namespace monocular_eye_hand
