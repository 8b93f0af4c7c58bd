#include "monocular_eye_hand/features/gradient.h"

#include <algorithm>
#include <array>
#include <cmath>

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
void filterVertical(const float* const* rows, const float* g, const float* d, int cols, float* smooth,
                    float* derivative) {
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
void filterHorizontal(const float* smooth, const float* derivative, const float* g, const float* d, int cols,
                      float* dx, float* dy, float* magnitude) {
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

struct Filters {
  decltype(&filterVertical<1>) vertical;
  decltype(&filterHorizontal<1>) horizontal;
};
template <int R>
constexpr Filters filters() {
  return {&filterVertical<R>, &filterHorizontal<R>};
}
const std::array<Filters, kMaxRadius> kFilters = {filters<1>(), filters<2>(), filters<3>(), filters<4>(),
                                                  filters<5>(), filters<6>(), filters<7>(), filters<8>()};

// Quantile of the absolute second differences at the given step over a sparse set of rows.
double secondDifferenceNoise(const cv::Mat& grey, int step) {
  constexpr int kBins = 512;
  constexpr double kShare = 1.0 / 3, kNormalQuantile = 0.4307;  // P(|N(0,1)| < 0.4307) = 1/3
  std::array<int64_t, kBins> histogram{};
  int64_t total = 0;
  for (int y = step; y + step < grey.rows; y += 5) {
    const uchar *a = grey.ptr(y - step), *b = grey.ptr(y), *c = grey.ptr(y + step);
    for (int x = step; x + step < grey.cols; ++x) {
      if (b[x] == 0 || b[x] == 255) continue;  // clipped: noise is cut off there
      const int v = a[x - step] - 2 * a[x] + a[x + step] - 2 * b[x - step] + 4 * b[x] - 2 * b[x + step] +
                    c[x - step] - 2 * c[x] + c[x + step];
      ++histogram[std::min(std::abs(v), kBins - 1)];
      ++total;
    }
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

GradientRows::GradientRows(const cv::Mat& grey, const GradientKernel& kernel)
    : grey_(grey),
      kernel_(kernel),
      ring_(size_t(2 * kernel.radius + 1) * grey.cols),
      smooth_(grey.cols + 2 * kernel.radius),
      derivative_(grey.cols + 2 * kernel.radius) {}

const float* GradientRows::row(int y) {
  y = std::min(std::max(y, 0), grey_.rows - 1);
  const int slots = 2 * kernel_.radius + 1;
  while (loaded_ < y) {
    ++loaded_;
    const uchar* from = grey_.ptr(loaded_);
    float* to = ring_.data() + size_t(loaded_ % slots) * grey_.cols;
    for (int x = 0; x < grey_.cols; ++x) to[x] = float(from[x]);
  }
  return ring_.data() + size_t(y % slots) * grey_.cols;
}

void GradientRows::compute(int y, float* dx, float* dy, float* magnitude) {
  const int r = kernel_.radius, cols = grey_.cols;
  const float* rows[2 * kMaxRadius + 1];
  for (int k = -r; k <= r; ++k) rows[k + r] = row(y + k);
  const Filters& filter = kFilters[r - 1];
  float *s = smooth_.data() + r, *d = derivative_.data() + r;
  filter.vertical(rows, kernel_.smooth.data(), kernel_.derivative.data(), cols, s, d);
  for (float* v : {s, d}) {
    std::fill(v - r, v, v[0]);
    std::fill(v + cols, v + cols + r, v[cols - 1]);
  }
  filter.horizontal(s, d, kernel_.smooth.data(), kernel_.derivative.data(), cols, dx, dy, magnitude);
}

}  // namespace monocular_eye_hand
