// Turn the image, and the answer turns: by quarter turns, where no pixel is interpolated.
#include <gtest/gtest.h>

#include <cmath>

#include "synthetic.h"

namespace monocular_eye_hand {
namespace {

constexpr int kWidth = 320, kHeight = 240;

// A quarter turn of the image takes (u, v) to (height - 1 - v, u).
Eigen::Vector2d turned(const Eigen::Vector2d& uv, int quarters) {
  int width = kWidth, height = kHeight;
  Eigen::Vector2d p = uv;
  for (int k = 0; k < quarters; ++k) {
    p = {height - 1 - p.y(), p.x()};
    std::swap(width, height);
  }
  return p;
}

cv::Mat turned(const cv::Mat& image, int quarters) {
  cv::Mat out = image.clone();
  for (int k = 0; k < quarters; ++k) cv::rotate(out.clone(), out, cv::ROTATE_90_CLOCKWISE);
  return out;
}

FeatureSet featuresOf(const cv::Mat& image) {
  return detectFeatures(image, testCamera(image.cols, image.rows));
}

// Shapes that do not touch, so that no decision between them hangs on a hair.
cv::Mat apart(double noise, std::mt19937* g) {
  SyntheticScene scene(90);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) {
      const Eigen::Vector2d c(40 + 80 * x + uniform(*g, -4, 4), 40 + 80 * y + uniform(*g, -4, 4));
      const double grey = otherGrey(g, 90, 40);
      if ((x + y) % 2)
        scene.add(randomPolygon(g, c, uniform(*g, 20, 32), 3 + (x + y) % 3, grey));
      else
        scene.add(FilledEllipse{{c, uniform(*g, 22, 32), uniform(*g, 8, 20), uniform(*g, -1.5, 1.5)}, grey});
    }
  return scene.render(testCamera(kWidth, kHeight), noise, g);
}

class Turns : public testing::TestWithParam<int> {};

TEST_P(Turns, SegmentsTurnWithTheImage) {
  std::mt19937 g(29);
  for (const double noise : {0.0, 3.0}) {
    const cv::Mat image = apart(noise, &g);
    const FeatureSet before = featuresOf(image), after = featuresOf(turned(image, GetParam()));
    int compared = 0;
    for (const LineSegment& s : before.segments) {
      if (s.length() < 15) continue;
      const Eigen::Vector2d p = turned(s.p, GetParam()), q = turned(s.q, GetParam());
      const Eigen::Vector2d d = (q - p).normalized(), n(-d.y(), d.x());
      double nearest = 1e9;  // bright side, and with it the order of the ends, turn too
      for (const LineSegment& t : after.segments)
        if ((t.p - p).norm() < 1.5 && (t.q - q).norm() < 1.5)
          nearest = std::min(nearest, std::max(std::fabs(n.dot(t.p - p)), std::fabs(n.dot(t.q - q))));
      EXPECT_LT(nearest, noise > 0 ? 0.1 : 0.02) << "noise " << noise << ", from " << s.p.transpose();
      ++compared;
    }
    EXPECT_GE(compared, 20);
  }
}

TEST_P(Turns, EllipsesTurnWithTheImage) {
  std::mt19937 g(31);
  for (const double noise : {0.0, 3.0}) {
    const cv::Mat image = apart(noise, &g);
    const FeatureSet before = featuresOf(image), after = featuresOf(turned(image, GetParam()));
    EXPECT_EQ(before.ellipses.size(), 6u);
    ASSERT_EQ(before.ellipses.size(), after.ellipses.size()) << "noise " << noise;
    for (const DetectedEllipse& e : before.ellipses) {
      const Eigen::Vector2d centre = turned(e.ellipse.centre, GetParam());
      const auto found =
          std::find_if(after.ellipses.begin(), after.ellipses.end(),
                       [&](const DetectedEllipse& o) { return (o.ellipse.centre - centre).norm() < 1; });
      ASSERT_NE(found, after.ellipses.end()) << "noise " << noise;
      const double tolerance = noise > 0 ? 0.05 : 0.01;
      EXPECT_LT((found->ellipse.centre - centre).norm(), tolerance);
      EXPECT_NEAR(found->ellipse.a, e.ellipse.a, 2 * tolerance);
      EXPECT_NEAR(found->ellipse.b, e.ellipse.b, 2 * tolerance);
      const double turn = found->ellipse.angle - e.ellipse.angle - GetParam() * M_PI / 2;
      EXPECT_LT(std::fabs(turn - M_PI * std::round(turn / M_PI)), 0.02);
      EXPECT_EQ(found->bright_inside, e.bright_inside);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Quarters, Turns, testing::Values(1, 2, 3));

}  // namespace
}  // namespace monocular_eye_hand
