// What is compiled for vector instructions and chosen at run time gives the results of the plain code, bit by
// bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flat_features.h"

std::vector<double> plainFeatures(const cv::Mat& grey);

namespace monocular_eye_hand {
namespace {

cv::Mat clutter(int width, int height, double noise, std::mt19937* g) {
  SyntheticScene scene(90);
  for (int k = 0; k < 24; ++k) {
    const Eigen::Vector2d c(uniform(*g, 0, width), uniform(*g, 0, height));
    if (k % 2)
      scene.add(randomPolygon(g, c, uniform(*g, 8, 50), 3 + k % 4, uniform(*g, 20, 240)));
    else
      scene.add(FilledEllipse{{c, uniform(*g, 15, 40), uniform(*g, 6, 15), uniform(*g, -1, 1)},
                              uniform(*g, 20, 240)});
  }
  return scene.render(testCamera(width, height), noise, g);
}

TEST(VectorClones, GiveWhatThePlainCodeGives) {
  std::mt19937 g(23);
  // Widths around the lengths of vectors and of runs.
  for (const int width : {5, 15, 16, 17, 33, 64, 201, 320})
    for (const double noise : {0.0, 2.0, 12.0}) {
      const cv::Mat image = clutter(width, 150, noise, &g);
      const std::vector<double> ours = flatFeatures(image), plain = plainFeatures(image);
      ASSERT_EQ(ours.size(), plain.size()) << width << " px wide, noise " << noise;
      if (width > 100) {
        EXPECT_GT(ours.size(), 1000u) << "nothing to compare";
      }
      const auto [a, b] = std::mismatch(ours.begin(), ours.end(), plain.begin());
      ASSERT_EQ(a, ours.end()) << width << " px wide, noise " << noise << ": value " << a - ours.begin()
                               << " is " << *a << ", plain " << *b;
    }
}

}  // namespace
}  // namespace monocular_eye_hand
