#include "monocular_eye_hand/pose/bent_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {
namespace {

constexpr double kCentre = 40;

// Places 1.5 px apart on a circle about (kCentre, kCentre), normals outwards.
std::vector<ContourPlace> circle(double radius, int feature) {
  std::vector<ContourPlace> places;
  const int n = int(2 * M_PI * radius / 1.5);
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d normal(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n));
    places.push_back({Eigen::Vector2d(kCentre, kCentre) + radius * normal, normal, feature});
  }
  return places;
}

TEST(Curvatures, OfCirclesAndEitherSide) {
  for (double radius : {8.0, 20.0, 100.0}) {
    std::vector<ContourPlace> places = circle(radius, 3);
    for (double c : curvatures(places)) EXPECT_NEAR(c, -1 / radius, 0.2 / radius) << radius;
    for (ContourPlace& place : places) place.normal = -place.normal;
    for (double c : curvatures(places)) EXPECT_NEAR(c, 1 / radius, 0.2 / radius) << radius;
  }
}

TEST(Curvatures, LinesHaveNoneEvenBesideACircle) {
  std::vector<ContourPlace> places = circle(8, 0);
  const size_t first = places.size();
  for (int i = 0; i < 30; ++i) places.push_back({{20.0 + 1.5 * i, kCentre + 9}, {0, 1}, 1});
  const std::vector<double> found = curvatures(places);
  for (size_t i = first; i < places.size(); ++i) EXPECT_NEAR(found[i], 0, 1e-9);
  EXPECT_NEAR(found[0], -1.0 / 8, 0.03);
}

TEST(Curvatures, TooFewPlacesAndTheSamePlaceHaveNone) {
  EXPECT_TRUE(curvatures({}).empty());
  std::vector<ContourPlace> places = circle(8, 0);
  places.resize(3);
  for (double c : curvatures(places)) EXPECT_EQ(c, 0);
  for (double c : curvatures(std::vector<ContourPlace>(9, places[0]))) EXPECT_EQ(c, 0);
}

// A dark disc, blurred: its steepest points lie within its outline, and are moved back onto it.
TEST(UndoBlurOfBends, BringsTheEdgeOfASmallDiscBack) {
  constexpr double kRadius = 6, kBlur = 1.2;
  constexpr int kSize = 80, kFine = 16;
  cv::Mat fine(kSize * kFine, kSize * kFine, CV_32F);
  for (int v = 0; v < fine.rows; ++v)
    for (int u = 0; u < fine.cols; ++u)
      fine.at<float>(v, u) =
          std::hypot((u + 0.5) / kFine - 0.5 - kCentre, (v + 0.5) / kFine - 0.5 - kCentre) < kRadius ? 60.0f
                                                                                                     : 180.0f;
  cv::Mat image;
  cv::resize(fine, image, {kSize, kSize}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(image, image, {}, kBlur);
  image.convertTo(image, CV_8U);
  const Camera camera{kSize, kSize, 80, 80, kCentre, kCentre, DistortionModel::kNone, {}};
  const FeatureSet features = detectFeatures(image, camera);
  ASSERT_GT(features.points.size(), 20u);

  const Rigid3 pose{Eigen::Matrix3d::Identity(), {0, 0, 1}};  // the disc on the plane z = 1
  std::vector<FeatureSample> samples;
  double before = 0, after = 0;
  for (const EdgePoint& point : features.points) {
    const Eigen::Vector2d uv = point.uv.cast<double>(),
                          outwards = (uv.array() - kCentre).matrix().normalized();
    FeatureSample sample;
    sample.line.p_in_object << kRadius * outwards / 80, 0;
    sample.line.uv = uv;
    sample.line.normal = outwards;
    sample.appearance.blur = point.blur;
    samples.push_back(sample);
    before += (uv.array() - kCentre).matrix().norm() - kRadius;
  }
  correctBlurBias(pose, camera, &samples);
  for (const FeatureSample& s : samples) after += (s.line.uv.array() - kCentre).matrix().norm() - kRadius;
  const double n = double(samples.size());
  EXPECT_LT(before / n, -0.1);
  EXPECT_LT(std::abs(after / n), 0.4 * std::abs(before / n));
}

}  // namespace
}  // namespace monocular_eye_hand
