#include <gtest/gtest.h>

#include <random>

#include "features/edge_detection.h"
#include "features/ellipse_fitting.h"
#include "features/line_fitting.h"
#include "monocular_eye_hand/features/gradient.h"
#include "synthetic.h"

namespace monocular_eye_hand {
namespace {

TEST(EdgePixels, TellPointsApart) {
  constexpr int kCols = 131, kRows = 9;
  std::mt19937 g(4);
  std::vector<std::vector<int>> truth(kRows, std::vector<int>(kCols, -1));
  EdgePixels pixels;
  pixels.reset(kCols, kRows);
  int points = 0;
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kCols; ++x)
      if (uniform(g, 0, 1) < 0.4) {
        pixels.add(x, y, points);
        truth[y][x] = points++;
      }

  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x + 5 <= kCols; ++x)
      for (int k = 0; k < 5; ++k) {
        const int point = truth[y][x + k];
        ASSERT_EQ(pixels.run(x, y, 5) >> k & 1, point >= 0 ? 1u : 0u) << x << " " << y << " " << k;
        if (point >= 0) {
          ASSERT_EQ(pixels.point(x + k, y), point);
        }
      }
}

// The definition, pixel by pixel: magnitude at the threshold, above the one behind, not below the one ahead.
TEST(EdgePoints, AreTheMaximaAlongTheGradient) {
  for (const int cols : {5, 17, 20, 36, 67}) {
    std::mt19937 g(cols);
    const int rows = 24;
    cv::Mat image(rows, cols, CV_8U);
    for (int i = 0; i < rows * cols; ++i) image.data[i] = uchar(uniform(g, 0, 255));

    FeatureOptions options;
    options.noise_factor = 0;
    EdgeMap edges;
    EdgeDetector(options).detect(image, &edges);

    const GradientKernel kernel = gradientKernel(options.smoothing_sigma);
    GradientRows gradients(kernel);
    gradients.start(image);
    cv::Mat dx(rows, cols, CV_32F), dy(rows, cols, CV_32F), m(rows, cols, CV_32F);
    for (int y = 0; y < rows; ++y) gradients.compute(y, dx.ptr<float>(y), dy.ptr<float>(y), m.ptr<float>(y));

    size_t next = 0;
    for (int y = 2; y < rows - 2; ++y)
      for (int x = 2; x < cols - 2; ++x) {
        const float gx = dx.at<float>(y, x), gy = dy.at<float>(y, x), here = m.at<float>(y, x);
        const bool wide = std::fabs(gx) >= std::fabs(gy);
        const double t = wide ? gy / gx : gx / gy;
        const int sx = wide ? 1 : (t >= 0 ? 1 : -1), sy = wide ? (t >= 0 ? 1 : -1) : 1;
        const auto along = [&](int sign) {
          const double straight = wide ? m.at<float>(y, x + sign) : m.at<float>(y + sign, x);
          const double corner = m.at<float>(y + sign * sy, x + sign * sx);
          return straight + std::fabs(t) * (corner - straight);
        };
        const double margin = std::min({here - along(-1), here - along(1), here - edges.threshold});
        const bool found = next < edges.points.size() && edges.x[next] == x && edges.y[next] == y;
        if (std::fabs(margin) > 1e-3) {
          EXPECT_EQ(found, margin > 0) << cols << ": " << x << " " << y;
        }
        if (found) ++next;
      }
    EXPECT_EQ(next, edges.points.size());
  }
}

TEST(FitPoints, AreSpreadOverTheRangesAndPaddedByNothing) {
  std::vector<EdgePoint> points(1000);
  for (int i = 0; i < 1000; ++i) {
    points[i].uv = {float(i), 0};
    points[i].sigma = 0.1f;
  }
  FitPoints taken;
  taken.assign(points, {{100, 303}, {700, 50}}, 60);
  ASSERT_GT(taken.count(), 50);
  ASSERT_LE(taken.count(), 61);
  for (int i = 0; i < taken.count(); ++i) {
    const int at = int(taken.x()[i]);
    EXPECT_TRUE((at >= 100 && at < 403) || (at >= 700 && at < 750)) << at;
    EXPECT_NEAR(taken.weight()[i], 1 / fitVariance(points[0]), 1e-9);
  }
  for (int i = taken.count(); i < taken.padded(); ++i) EXPECT_EQ(taken.weight()[i], 0);
  taken.assign(points, {{0, 1000}}, 1000);
  EXPECT_LE(taken.count(), FitPoints::kCapacity);
}

// The number of points beyond a multiple of the lanes changes nothing but the points themselves.
TEST(FitPoints, PaddingDoesNotMoveTheFit) {
  const Ellipse truth{{50, 40}, 30, 18, 0.4};
  for (int n = 40; n < 48; ++n) {
    std::vector<EdgePoint> points(n);
    for (int i = 0; i < n; ++i) {
      points[i].uv = truth.at(2 * M_PI * i / n).cast<float>();
      points[i].sigma = 0.1f;
    }
    FitPoints taken;
    taken.assign(points, {{0, n}}, n);
    const EllipseFit fit = refineEllipse(taken, fitEllipseDirect(taken).ellipse, 5);
    ASSERT_TRUE(fit.valid) << n;
    EXPECT_LT((fit.ellipse.centre - truth.centre).norm(), 1e-4) << n;
    EXPECT_LT(fit.rms, 1e-4) << n;
    // The centre is known as well as the mean of as many distances allows: about sigma sqrt(2 / n).
    const double sigma = std::sqrt(covarianceOf(fit)(0, 0) * n / (2 * fitVariance(points[0])));
    EXPECT_NEAR(sigma, 1, 0.25) << n;
  }
}

}  // namespace
}  // namespace monocular_eye_hand
