#include "recognition/evidence.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "recognition/edge_raster.h"
#include "support/camera.h"

namespace monocular_eye_hand {
namespace {

constexpr double kDegree = M_PI / 180;
const int kVertical = orientationBin(0, 1), kHorizontal = orientationBin(1, 0);

RectDomain plainDomain(int width, int height) {
  RectDomain domain;
  domain.width = width;
  domain.height = height;
  return domain;
}

// An edge through `from` along `angle`, a point per pixel.
void addEdge(FeatureSet* features, const Eigen::Vector2f& from, double angle, int length,
             float gradient = 20) {
  const Eigen::Vector2f along(float(std::cos(angle)), float(std::sin(angle)));
  EdgeTrace trace;
  trace.first = int(features->points.size());
  trace.count = length;
  for (int i = 0; i < length; ++i) {
    EdgePoint point;
    point.uv = from + float(i) * along;
    point.normal = {along.y(), -along.x()};
    point.gradient = gradient;
    point.sigma = 0.1f;
    features->points.push_back(point);
  }
  features->traces.push_back(trace);
}

Camera distortedCamera() {
  return withWebcamLens({320, 240, 310, 311, 162, 118, DistortionModel::kNone, {}});
}

TEST(OrientationBin, IsTheNearestForEveryDirectionAndBothSenses) {
  const double width = M_PI / kOrientationBins;
  for (int i = 0; i < 3600; ++i) {
    const double angle = 0.1 * i * kDegree;
    for (float length : {1e-3f, 1.0f, 500.0f}) {
      const int bin = orientationBin(length * float(std::cos(angle)), length * float(std::sin(angle)));
      ASSERT_GE(bin, 0);
      ASSERT_LT(bin, kOrientationBins);
      double off = std::fmod(angle - bin * width, M_PI);  // to the bin's centre, modulo pi
      off = std::abs(off > M_PI / 2 ? off - M_PI : off < -M_PI / 2 ? off + M_PI : off);
      ASSERT_LE(off, width / 2 + 0.5 * kDegree) << "angle " << 0.1 * i << " degrees, bin " << bin;
    }
  }
}

TEST(OrientationBin, WrapsAtPi) {
  EXPECT_EQ(orientationBin(1, 0), 0);
  EXPECT_EQ(orientationBin(-1, 0), 0);
  EXPECT_EQ(orientationBin(-1, 0.01f), 0);
  EXPECT_EQ(orientationBin(1, -0.01f), 0);
  EXPECT_EQ(orientationBin(0, 1), kOrientationBins / 2);
  EXPECT_EQ(orientationBin(0, -1), kOrientationBins / 2);
}

TEST(EvidenceMap, AnEdgeOfTheDirectionSpeaksForAndEverythingElseAgainst) {
  FeatureSet features;
  addEdge(&features, {80, 20}, M_PI / 2, 80);
  const EvidenceMap map(features, plainDomain(160, 120));
  EXPECT_EQ(map.full().width(), 160);
  EXPECT_EQ(map.full().height(), 120);
  EXPECT_GT(map.full().at(kVertical, 80, 60), kEvidenceUnit) << "on the edge, along it";
  EXPECT_GT(map.full().at(kVertical, 81, 60), kEvidenceUnit) << "a pixel beside it";
  EXPECT_GE(map.full().at(kVertical, 80, 60), map.full().at(kVertical, 83, 60));
  EXPECT_GE(map.full().at(kVertical, 83, 60), map.full().at(kVertical, 95, 60));
  EXPECT_LT(map.full().at(kHorizontal, 80, 60), -kEvidenceUnit) << "on the edge, across it";
  EXPECT_LT(map.full().at(kVertical, 40, 60), -kEvidenceUnit) << "where nothing is";
  EXPECT_NE(map.full().at(kVertical, 0, 0), kOutside);
  for (const auto& [x, y] : {std::pair{-1, 0}, {0, -1}, {160, 0}, {0, 120}, {5000, 5000}})
    EXPECT_EQ(map.full().at(kVertical, x, y), kOutside) << x << ", " << y;
}

TEST(EvidenceMap, APointCountsForTheTwoBinsAroundItsDirection) {
  for (double degrees : {7.0, 40.0, 83.0, 100.0, 172.0, 179.0}) {
    FeatureSet features;
    addEdge(&features, {80, 60}, degrees * kDegree, 20);
    const EvidenceMap map(features, plainDomain(160, 120));
    const int low = int(degrees / 180 * kOrientationBins), high = (low + 1) % kOrientationBins;
    for (int bin = 0; bin < kOrientationBins; ++bin)
      EXPECT_EQ(map.full().at(bin, 80, 60) > 0, bin == low || bin == high)
          << degrees << " degrees, bin " << bin;
  }
}

TEST(EvidenceMap, AnEdgeAmidManySaysLessThanOneOnClearGround) {
  FeatureSet features;
  addEdge(&features, {40, 20}, M_PI / 2, 160);
  for (int u = 240; u < 340; u += 5) addEdge(&features, {float(u), 20}, M_PI / 2, 160);
  const EvidenceMap map(features, plainDomain(400, 200));
  EXPECT_GT(map.full().at(kVertical, 40, 100), 0);
  EXPECT_LT(map.full().at(kVertical, 290, 100), map.full().at(kVertical, 40, 100) / 2);
  EXPECT_LT(map.full().at(kVertical, 140, 100), 0);
}

TEST(EvidenceMap, WithoutASingleEdgeNothingSpeaksForAnything) {
  const EvidenceMap map(FeatureSet{}, plainDomain(64, 48));
  for (int bin = 0; bin < kOrientationBins; ++bin)
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) ASSERT_LT(map.full().at(bin, x, y), 0);
}

TEST(EvidenceMap, HalfResolutionShowsEverySecondPixelOfAnOddSizedImage) {
  FeatureSet features;
  addEdge(&features, {30, 10}, 0.7, 60);
  const EvidenceMap map(features, plainDomain(101, 75));
  ASSERT_EQ(map.half().width(), 51);
  ASSERT_EQ(map.half().height(), 38);
  for (int bin = 0; bin < kOrientationBins; ++bin)
    for (int y = 0; y < 38; ++y)
      for (int x = 0; x < 51; ++x) ASSERT_EQ(map.half().at(bin, x, y), map.full().at(bin, 2 * x, 2 * y));
}

TEST(EvidenceMap, FollowsTheDomainOfALens) {
  const RectDomain domain = rectDomain(distortedCamera());
  ASSERT_LT(domain.u0, 0);
  FeatureSet features;
  addEdge(&features, {160, 60}, M_PI / 2, 100);
  const EvidenceMap map(features, domain);
  EXPECT_EQ(map.u0(), domain.u0);
  EXPECT_EQ(map.v0(), domain.v0);
  EXPECT_GT(map.full().at(kVertical, 160 - domain.u0, 110 - domain.v0), 0);
  int outside = 0;
  for (int y = 0; y < domain.height; ++y)
    for (int x = 0; x < domain.width; ++x) {
      const bool covered = domain.contains(x + domain.u0, y + domain.v0);
      ASSERT_EQ(map.full().at(kVertical, x, y) == kOutside, !covered) << x << ", " << y;
      outside += !covered;
    }
  EXPECT_GT(outside, 0);
}

TEST(RectDomain, IsTheImageWithoutDistortion) {
  Camera camera = distortedCamera();
  camera.model = DistortionModel::kNone;
  camera.d = {};
  const RectDomain domain = rectDomain(camera);
  EXPECT_EQ(domain.u0, 0);
  EXPECT_EQ(domain.v0, 0);
  EXPECT_EQ(domain.width, 320);
  EXPECT_EQ(domain.height, 240);
  EXPECT_TRUE(domain.contains(0, 0));
  EXPECT_TRUE(domain.contains(319.4, 239.4));
  EXPECT_FALSE(domain.contains(319.6, 0));
  EXPECT_FALSE(domain.contains(0, -0.6));
}

TEST(RectDomain, ReachesToTheUndistortedBorderAndNotBeyond) {
  const Camera camera = distortedCamera();
  const RectDomain domain = rectDomain(camera);
  const auto inBounds = [&](const Eigen::Vector2d& p) {
    return p.x() >= domain.u0 - 0.5 && p.y() >= domain.v0 - 0.5 && p.x() <= domain.u0 + domain.width - 0.5 &&
           p.y() <= domain.v0 + domain.height - 0.5;
  };

  const auto walk = [&](double inset, auto&& look) {
    for (int u = 0; u < camera.width; ++u)
      for (double v : {inset, camera.height - 1 - inset}) look(Eigen::Vector2d(u, v));
    for (int v = 0; v < camera.height; ++v)
      for (double u : {inset, camera.width - 1 - inset}) look(Eigen::Vector2d(u, v));
  };

  walk(0,
       [&](const Eigen::Vector2d& raw) { ASSERT_TRUE(inBounds(camera.undistort(raw))) << raw.transpose(); });
  walk(1.5, [&](const Eigen::Vector2d& raw) {
    if (raw.x() < 1.5 || raw.y() < 1.5 || raw.x() > camera.width - 2.5 || raw.y() > camera.height - 2.5)
      return;
    const Eigen::Vector2d p = camera.undistort(raw);
    ASSERT_TRUE(domain.contains(p.x(), p.y())) << raw.transpose();
  });
  walk(-3, [&](const Eigen::Vector2d& raw) {
    const Eigen::Vector2d p = camera.undistort(raw);
    ASSERT_FALSE(domain.contains(p.x(), p.y())) << raw.transpose();
  });
}

TEST(RectifiedGrey, TakesEachPixelFromWhereTheLensPutIt) {
  const Camera camera = distortedCamera();
  const RectDomain domain = rectDomain(camera);
  cv::Mat ramp(camera.height, camera.width, CV_8UC1);
  for (int v = 0; v < ramp.rows; ++v)
    for (int u = 0; u < ramp.cols; ++u) ramp.at<uint8_t>(v, u) = uint8_t(u / 2 + v / 4);
  const cv::Mat rect = rectifiedGrey(ramp, camera, domain);
  ASSERT_EQ(rect.size(), cv::Size(domain.width, domain.height));
  for (int y = 0; y < rect.rows; y += 7)
    for (int x = 0; x < rect.cols; x += 7) {
      if (!domain.contains(x + domain.u0, y + domain.v0)) continue;
      const Eigen::Vector2d raw = camera.distort({double(x + domain.u0), double(y + domain.v0)});
      ASSERT_NEAR(rect.at<uint8_t>(y, x), raw.x() / 2 + raw.y() / 4, 1.6) << x << ", " << y;
    }
}

class EdgeRasterTest : public testing::Test {
 protected:
  int find(const Eigen::Vector2d& uv, double normal_degrees, double range) const {
    const EdgeRaster raster(features_, plainDomain(160, 120));
    return raster.find(uv, {std::cos(normal_degrees * kDegree), std::sin(normal_degrees * kDegree)}, range);
  }
  FeatureSet features_;
};

TEST_F(EdgeRasterTest, FindsThePointBesideFromBothSidesWithinTheRange) {
  addEdge(&features_, {80.3f, 20}, M_PI / 2, 80);
  for (double u : {77.4, 80.0, 80.3, 83.1}) {
    const int found = find({u, 60.2}, 0, 4);
    ASSERT_GE(found, 0) << u;
    EXPECT_NEAR(features_.points[found].uv.y(), 60.2, 1.01) << u;
    EXPECT_EQ(find({u, 60.2}, 180, 4), found) << "the sense of the normal does not matter";
  }
  EXPECT_EQ(find({74, 60}, 0, 4), -1);
  EXPECT_GE(find({74, 60}, 0, 7), 0);
  EXPECT_EQ(find({87, 60}, 0, 4), -1);
}

TEST_F(EdgeRasterTest, TakesOnlyPointsOfAboutTheDirection) {
  addEdge(&features_, {80, 20}, M_PI / 2, 80);
  EXPECT_GE(find({80, 60}, 20, 3), 0);
  EXPECT_GE(find({80, 60}, -20, 3), 0);
  EXPECT_EQ(find({80, 60}, 30, 3), -1);
  EXPECT_EQ(find({80, 60}, 90, 3), -1);
}

TEST_F(EdgeRasterTest, SlantedEdgesCannotBeSlippedThrough) {
  for (double degrees = 0; degrees < 180; degrees += 15) {
    features_ = {};
    const double a = degrees * kDegree;
    const Eigen::Vector2d along(std::cos(a), std::sin(a)), across(-along.y(), along.x());
    const Eigen::Vector2d middle(80, 60);
    addEdge(&features_, (middle - 30 * along).cast<float>(), a, 60);
    for (double s = -20; s < 20; s += 1.3)
      for (double off : {-3.5, 0.0, 3.5})
        ASSERT_GE(find(middle + s * along + off * across, degrees + 90, 5), 0)
            << degrees << " degrees, " << s << " along, " << off << " off";
  }
}

TEST_F(EdgeRasterTest, PrefersTheNearerOfEqualsAndTheMuchStronger) {
  addEdge(&features_, {78, 20}, M_PI / 2, 80, 20);  // points 0..79
  addEdge(&features_, {85, 20}, M_PI / 2, 80, 20);  // points 80..159
  EXPECT_LT(find({80, 60}, 0, 6), 80);
  EXPECT_GE(find({83, 60}, 0, 6), 80);
  for (int i = 80; i < 160; ++i) features_.points[i].gradient = 200;
  EXPECT_GE(find({81, 60}, 0, 6), 80) << "ten times as strong, one pixel farther";
}

TEST_F(EdgeRasterTest, TheBorderOfAShadowBesideDoesNotWinByItsContrast) {
  addEdge(&features_, {80, 20}, M_PI / 2, 80, 20);  // points 0..79
  addEdge(&features_, {88, 20}, M_PI / 2, 80, 40);
  for (double u : {78.0, 80.0, 81.0}) {
    const int found = find({u, 60}, 0, 10);
    ASSERT_GE(found, 0) << u;
    EXPECT_LT(found, 80) << u;
  }
}

TEST_F(EdgeRasterTest, EveryStepOfAWalkIsLookedAt) {
  for (int off = -13; off <= 13; ++off) {
    features_ = {};
    addEdge(&features_, {80.0f + float(off), 40}, M_PI / 2, 41);
    EXPECT_GE(find({80, 60}, 0, 13), 0) << off << " px off";
    if (std::abs(off) > 2) {
      EXPECT_EQ(find({80, 60}, 0, std::abs(off) - 2), -1) << off << " px off";
    }
  }
}

TEST_F(EdgeRasterTest, OutsideTheImageThereIsNothing) {
  addEdge(&features_, {0, 0}, M_PI / 2, 120);
  EXPECT_EQ(find({-50, 60}, 0, 5), -1);
  EXPECT_EQ(find({500, 60}, 0, 5), -1);
  EXPECT_GE(find({-2, 60}, 0, 5), 0) << "a prediction beyond the border may still touch an edge at it";
  const EdgeRaster raster(features_, plainDomain(160, 120));
  EXPECT_EQ(raster.indexAt(-3, 5), -1);
  EXPECT_EQ(raster.indexAt(160, 5), -1);
  EXPECT_EQ(raster.indexAt(0, 7), 7);
}

}  // namespace
}  // namespace monocular_eye_hand
