#include "monocular_eye_hand/features/gradient.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "monocular_eye_hand/geometry/vector_clones.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMaxRadius = 8;

// Full kernel with both sides.
std::vector<double> unfold(const std::vector<float>& half, double sign) {
  const int r = int(half.size()) - 1;
  std::vector<double> full(2 * r + 1);
  for (int k = -r; k <= r; ++k) full[k + r] = (k < 0 ? sign : 1.0) * half[std::abs(k)];
  return full;
}

double energy(const std::vector<double>& v) {
  double sum = 0;
  for (double x : v) sum += x * x;
  return sum;
}

template <int R>
MONOCULAR_EYE_HAND_INLINE void filterVertical(const float* const* rows, const float* g, const float* d,
                                              int cols, float* __restrict smooth,
                                              float* __restrict derivative) {
  for (int x = 0; x < cols; ++x) {
    float s = g[0] * rows[R][x], t = 0;
    for (int k = 1; k <= R; ++k) {
      s += g[k] * (rows[R + k][x] + rows[R - k][x]);
      t += d[k] * (rows[R + k][x] - rows[R - k][x]);
    }
    smooth[x] = s;
    derivative[x] = t;
  }
}

template <int R>
MONOCULAR_EYE_HAND_INLINE void filterHorizontal(const float* smooth, const float* derivative, const float* g,
                                                const float* d, int cols, float* __restrict dx,
                                                float* __restrict dy, float* __restrict magnitude) {
  for (int x = 0; x < cols; ++x) {
    float s = g[0] * derivative[x], t = 0;
    for (int k = 1; k <= R; ++k) {
      s += g[k] * (derivative[x + k] + derivative[x - k]);
      t += d[k] * (smooth[x + k] - smooth[x - k]);
    }
    dx[x] = t;
    dy[x] = s;
    magnitude[x] = std::sqrt(t * t + s * s);
  }
}

// One row's filtering; s and d are padded by the radius on both sides.
struct RowFilter {
  const float* rows[2 * kMaxRadius + 1];
  const float *g, *d;
  float *smooth, *derivative;
  int cols;
  float *dx, *dy, *magnitude;
};
template <int R>
MONOCULAR_EYE_HAND_INLINE void filterRow(const RowFilter& f) {
  float g[R + 1], d[R + 1];
  const float* rows[2 * R + 1];
  std::copy(f.g, f.g + R + 1, g);
  std::copy(f.d, f.d + R + 1, d);
  std::copy(f.rows, f.rows + 2 * R + 1, rows);
  filterVertical<R>(rows, g, d, f.cols, f.smooth, f.derivative);
  for (float* v : {f.smooth, f.derivative}) {
    std::fill(v - R, v, v[0]);
    std::fill(v + f.cols, v + f.cols + R, v[f.cols - 1]);
  }
  filterHorizontal<R>(f.smooth, f.derivative, g, d, f.cols, f.dx, f.dy, f.magnitude);
}
MONOCULAR_EYE_HAND_VECTOR_CLONES
void filterRow(int radius, const RowFilter& f) {
  switch (radius) {
    case 1:
      return filterRow<1>(f);
    case 2:
      return filterRow<2>(f);
    case 3:
      return filterRow<3>(f);
    case 4:
      return filterRow<4>(f);
    case 5:
      return filterRow<5>(f);
    case 6:
      return filterRow<6>(f);
    case 7:
      return filterRow<7>(f);
    default:
      return filterRow<kMaxRadius>(f);
  }
}

// |second difference| by Immerkaer's mask at x = 0 .. count - 1, where the rows go on for `step` pixels on
// both sides; -1 where the middle is clipped and noise is cut off.
MONOCULAR_EYE_HAND_VECTOR_CLONES
void secondDifferences(const uchar* a, const uchar* b, const uchar* c, int step, int count,
                       int16_t* __restrict out) {
  for (int x = 0; x < count; ++x) {
    const int v = a[x - step] - 2 * a[x] + a[x + step] - 2 * b[x - step] + 4 * b[x] - 2 * b[x + step] +
                  c[x - step] - 2 * c[x] + c[x + step];
    const bool clipped = b[x] == 0 || b[x] == 255;
    out[x] = int16_t(clipped ? -1 : v < 0 ? -v : v);
  }
}

// Quantile of the absolute second differences at the given step over a sparse set of rows.
double secondDifferenceNoise(const cv::Mat& grey, int step) {
  constexpr int kBins = 512, kRun = 1024;                       // pixels looked at together
  constexpr double kShare = 1.0 / 3, kNormalQuantile = 0.4307;  // P(|N(0,1)| < 0.4307) = 1/3
  // Bin 0 counts the clipped ones. Four histograms, so that equal neighbours need not wait for each other.
  std::array<std::array<int32_t, kBins + 1>, 4> parts{};
  std::array<int16_t, kRun> differences;
  for (int y = step; y + step < grey.rows; y += 5)
    for (int x = step; x < grey.cols - step; x += kRun) {
      const int count = std::min(kRun, grey.cols - step - x);
      secondDifferences(grey.ptr(y - step) + x, grey.ptr(y) + x, grey.ptr(y + step) + x, step, count,
                        differences.data());
      for (int k = 0; k < count; ++k)
        ++parts[size_t(k & 3)][size_t(std::min(int(differences[size_t(k)]), kBins - 1) + 1)];
    }

  std::array<int64_t, kBins> histogram{};
  int64_t total = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    for (const auto& part : parts) histogram[size_t(bin)] += part[size_t(bin + 1)];
    total += histogram[size_t(bin)];
  }
  if (total == 0) return 0;

  const double wanted = kShare * double(total);
  double below = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double here = double(histogram[bin]);
    if (below + here >= wanted) {  // |v| = bin stands for the values from bin - 1/2 to bin + 1/2
      const double low = bin == 0 ? 0 : bin - 0.5, width = bin == 0 ? 0.5 : 1.0;
      return (low + width * (wanted - below) / here) / (6 * kNormalQuantile);
    }
    below += here;
  }
  return 0;
}

}  // namespace

GradientKernel gradientKernel(double sigma) {
  GradientKernel kernel;
  kernel.radius = std::min(kMaxRadius, std::max(1, int(std::ceil(3 * sigma))));
  const int r = kernel.radius;

  double sum = 0, moment = 0;
  std::vector<double> g(r + 1);
  for (int k = 0; k <= r; ++k) {
    g[k] = std::exp(-0.5 * k * k / (sigma * sigma));
    sum += (k == 0 ? 1 : 2) * g[k];
    moment += 2 * k * k * g[k];
  }
  for (int k = 0; k <= r; ++k) {
    kernel.smooth.push_back(float(g[k] / sum));
    kernel.derivative.push_back(float(k * g[k] / moment));
  }

  const std::vector<double> s = unfold(kernel.smooth, 1), d = unfold(kernel.derivative, -1);
  kernel.noise_gain = std::sqrt(energy(s) * energy(d));
  std::vector<double> difference(d.size() + 2, 0.0);
  for (size_t i = 0; i < d.size(); ++i) {
    difference[i] += 0.5 * d[i];
    difference[i + 2] -= 0.5 * d[i];
  }
  kernel.difference_gain = std::sqrt(energy(s) * energy(difference));
  // Sum of the autocorrelation = (sum of the kernel)^2 / energy, along the smoothing direction.
  kernel.correlation_length = 1.0 / energy(s);
  return kernel;
}

double imageNoise(const cv::Mat& grey) {
  const double rounding = 1 / std::sqrt(12.0);
  return std::max({rounding, secondDifferenceNoise(grey, 1), secondDifferenceNoise(grey, 2)});
}

void GradientRows::start(const cv::Mat& grey) {
  grey_ = &grey;
  loaded_ = -1;
  ring_.resize(size_t(2 * kernel_.radius + 1) * grey.cols);
  smooth_.resize(grey.cols + 2 * kernel_.radius);
  derivative_.resize(grey.cols + 2 * kernel_.radius);
}

const float* GradientRows::row(int y) {
  y = std::min(std::max(y, 0), grey_->rows - 1);
  const int slots = 2 * kernel_.radius + 1;
  while (loaded_ < y) {
    ++loaded_;
    const uchar* from = grey_->ptr(loaded_);
    float* to = ring_.data() + size_t(loaded_ % slots) * grey_->cols;
    for (int x = 0; x < grey_->cols; ++x) to[x] = float(from[x]);
  }
  return ring_.data() + size_t(y % slots) * grey_->cols;
}

void GradientRows::compute(int y, float* dx, float* dy, float* magnitude) {
  const int r = kernel_.radius;
  RowFilter filter;
  for (int k = -r; k <= r; ++k) filter.rows[k + r] = row(y + k);
  filter.g = kernel_.smooth.data();
  filter.d = kernel_.derivative.data();
  filter.smooth = smooth_.data() + r;
  filter.derivative = derivative_.data() + r;
  filter.cols = grey_->cols;
  filter.dx = dx;
  filter.dy = dy;
  filter.magnitude = magnitude;
  filterRow(r, filter);
}

}  // namespace monocular_eye_hand
