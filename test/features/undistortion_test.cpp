#include "features/undistortion.h"
#include "support/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace monocular_eye_hand {
namespace {

Camera camera(const std::string& lens, const std::vector<double>& coefficients, double focal) {
  return withLens({640, 480, focal, 1.01 * focal, 318, 243, DistortionModel::kNone, {}}, lens, coefficients);
}

/// A line of the ideal image as the lens shows it.
LinkedEdges seenLine(const Camera& c, const Eigen::Vector2d& from, const Eigen::Vector2d& to, int count) {
  LinkedEdges raw;
  for (int k = 0; k < count; ++k) {
    const DistortedPixel at = c.distortWithJacobian(from + (to - from) * k / (count - 1.0));
    const Eigen::Vector2d along = at.jacobian * (to - from);
    EdgePoint p{};
    p.uv = at.uv_raw.cast<float>();
    p.normal = Eigen::Vector2d(-along.y(), along.x()).normalized().cast<float>();
    p.sigma = 0.1f;
    p.blur = 1.0f;
    raw.points.push_back(p);
  }
  raw.traces.push_back({0, count, false});
  return raw;
}

TEST(Undistortion, LinesBecomeStraightUnderEveryLens) {
  for (const Camera& c :
       {camera("plumb_bob", {-0.28, 0.08, 0.001, -0.0005, 0}, 620),
        camera("rational_polynomial", {2.1, 0.9, 0.0004, -0.0003, 0.03, 2.4, 1.5, 0.2}, 620),
        camera("equidistant", {-0.012, 0.004, -0.003, 0.0006}, 300), camera("fisheye", {0, 0, 0, 0}, 220)}) {
    SCOPED_TRACE(distortionName(c));
    const Eigen::Vector2d from(20, 60), to(600, 130), along = (to - from).normalized();
    LinkedEdges rect;
    undistortEdges(seenLine(c, from, to, 200), c, 5, &rect);
    ASSERT_EQ(rect.points.size(), 200u);
    ASSERT_EQ(rect.traces.size(), 1u);
    for (const EdgePoint& p : rect.points) {
      const Eigen::Vector2d off = p.uv.cast<double>() - from, normal = p.normal.cast<double>();
      EXPECT_NEAR(off.x() * along.y() - off.y() * along.x(), 0, 2e-3);
      EXPECT_NEAR(std::abs(normal.dot(along)), 0, 1e-4);
    }
  }
}

TEST(Undistortion, WhatAFisheyeShowsBehindTheCameraIsLeftOut) {
  const Camera c = camera("equidistant", {0, 0, 0, 0}, 140);
  LinkedEdges raw, rect;
  for (int k = 0; k < 100; ++k) {
    EdgePoint p{};
    p.uv = Eigen::Vector2f(float(318 + 3 * k), 243.0f);  // up to 121 degrees off the axis
    p.normal = Eigen::Vector2f(0, 1);
    p.sigma = 0.1f;
    raw.points.push_back(p);
  }
  raw.traces.push_back({0, 100, false});
  undistortEdges(raw, c, 5, &rect);
  EXPECT_GT(rect.points.size(), 60u);
  EXPECT_LT(rect.points.size(), 74u);  // 90 degrees off the axis
  for (const EdgePoint& p : rect.points) EXPECT_TRUE(p.uv.allFinite());
}

}  // namespace
}  // namespace monocular_eye_hand
