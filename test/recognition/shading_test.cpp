// How well one light explains the greys of faces.
#include "recognition/shading.h"

#include <gtest/gtest.h>

#include <random>

namespace monocular_eye_hand {
namespace {

// Pixels of a ball of random looks under ambient light and one lamp, with noise.
std::vector<ShadedPixel> litBall(int count, double noise) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  const Eigen::Vector3f light(30, -60, -70);
  std::vector<ShadedPixel> pixels;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f n = Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
    pixels.push_back({n, 120 + light.dot(n) + float(noise) * normal(random)});
  }
  return pixels;
}

TEST(Shading, OfALitBodyIsExplained) { EXPECT_GT(shadingExplained(litBall(400, 3)), 0.97); }

TEST(FittedLight, IsTheLightThatWasThere) {
  const FittedLight fitted = fitLight(litBall(400, 3));
  EXPECT_NEAR((fitted.light - Eigen::Vector4d(120, 30, -60, -70)).norm(), 0, 3);
  EXPECT_NEAR(fitted.residual, 2, 0.5) << "the median of |noise| is 0.67 of its deviation";
  EXPECT_NEAR(fitted.grey({0, 0, -1}), 190, 2);
}

TEST(Shading, HighlightsDoNotBendTheLight) {
  std::vector<ShadedPixel> pixels = litBall(400, 3);
  for (size_t i = 0; i < 40; ++i) pixels[i].grey = 255;
  EXPECT_GT(shadingExplained(pixels), 0.7);
}

TEST(Shading, ThatHasNothingToDoWithTheNormalsIsNot) {
  std::vector<ShadedPixel> pixels = litBall(400, 3);
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i].grey = float(40 + (i * 7919) % 180);
  EXPECT_LT(shadingExplained(pixels), 0.1);
}

TEST(Shading, OfOneFlatFaceOrAFewPixelsTellsNothing) {
  std::vector<ShadedPixel> flat = litBall(400, 3);
  for (size_t i = 0; i < flat.size(); ++i) flat[i] = {{0, 0, -1}, float(100 + i % 5)};
  EXPECT_NEAR(shadingExplained(flat), 0, 0.1);
  EXPECT_EQ(shadingExplained(litBall(20, 3)), 0);
}

}  // namespace
}  // namespace monocular_eye_hand
