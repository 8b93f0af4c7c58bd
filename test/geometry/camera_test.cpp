#include "monocular_eye_hand/geometry/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <string>
#include <vector>

#include "support/camera.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Camera plain() { return {640, 480, 620, 615, 318.3, 243.7, DistortionModel::kNone, {}}; }

Camera with(const std::string& model, const std::vector<double>& d) { return withLens(plain(), model, d); }

std::vector<Camera> cameras() {
  return {plain(),
          with("plumb_bob", {-0.28, 0.08, 0.001, -0.0005, 0}),
          with("plumb_bob", {0.12, -0.2, -0.002, 0.001, 0.05}),
          with("plumb_bob", {-0.1, 0.02, 0.0005, 0.0003}),
          with("rational_polynomial", {2.1, 0.9, 0.0004, -0.0003, 0.03, 2.4, 1.5, 0.2}),
          with("equidistant", {-0.012, 0.004, -0.003, 0.0006}),
          with("fisheye", {0, 0, 0, 0})};
}

void expectRefused(const std::function<void()>& call, const std::vector<std::string>& named) {
  const std::string message = refusal(call);
  EXPECT_NE(message, kAccepted);
  for (const std::string& word : named) EXPECT_THAT(message, testing::HasSubstr(word));
}

TEST(Camera, UndistortInvertsDistort) {
  for (const Camera& c : cameras())
    for (int u = -20; u <= 660; u += 20)
      for (int v = -20; v <= 500; v += 20) {
        const Vector2d uv(u, v);
        EXPECT_LT((c.undistort(c.distort(uv)) - uv).norm(), 1e-9) << uv.transpose();
        EXPECT_LT((c.distort(c.undistort(uv)) - uv).norm(), 1e-9) << uv.transpose();
      }
}

TEST(Camera, ProjectsAndDistortsAsOpenCV) {
  for (const Camera& c : cameras()) {
    std::vector<cv::Point3d> points;
    for (double x = -0.5; x <= 0.5; x += 0.1)
      for (double y = -0.38; y <= 0.38; y += 0.095) points.push_back({x * 1.3, y * 1.3, 1.3});
    if (c.model == DistortionModel::kEquidistant) continue;  // below
    const cv::Matx33d k(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
    const std::vector<double> d(c.d.begin(), c.d.end());
    std::vector<cv::Point2d> expected;
    cv::projectPoints(points, cv::Vec3d::all(0), cv::Vec3d::all(0), k, d, expected);
    ASSERT_GT(points.size(), 80u);
    for (size_t i = 0; i < points.size(); ++i) {
      const Vector2d ideal = c.project({points[i].x, points[i].y, points[i].z}), raw = c.distort(ideal);
      EXPECT_NEAR(raw.x(), expected[i].x, 1e-9);
      EXPECT_NEAR(raw.y(), expected[i].y, 1e-9);
      const Vector3d ray = c.ray(ideal);
      EXPECT_LT((ray * points[i].z - Vector3d(points[i].x, points[i].y, points[i].z)).norm(), 1e-14);
    }
    std::vector<cv::Point2d> back;
    cv::undistortPoints(expected, back, k, d, cv::noArray(), k,
                        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-12));
    for (size_t i = 0; i < points.size(); ++i) {
      const Vector2d ours = c.undistort({expected[i].x, expected[i].y});
      EXPECT_NEAR(ours.x(), back[i].x, 1e-5);  // OpenCV stops its fixed-point iteration here
      EXPECT_NEAR(ours.y(), back[i].y, 1e-5);
    }
  }
}

TEST(Camera, IntrinsicsAreTheProjection) {
  const Camera c = plain();
  const Vector3d p(0.2, -0.1, 1.7), h = c.intrinsics() * p;
  EXPECT_LT((h.head<2>() / h.z() - c.project(p)).norm(), 1e-12);
}

TEST(Camera, ResizedMapsPixelsByTheirEdges) {
  // A pixel centre at u covers u - 0.5 .. u + 0.5; those edges scale.
  for (const Camera& c : cameras())
    for (const double factor : {2.0, 0.5, 0.25, 1.0, 3.0}) {
      const Camera r = c.resized(factor);
      EXPECT_EQ(r.width, int(640 * factor));
      EXPECT_EQ(r.height, int(480 * factor));
      const Vector3d p(0.21, -0.17, 0.9);
      const Vector2d uv = c.project(p), scaled = r.project(p);
      EXPECT_NEAR(scaled.x(), (uv.x() + 0.5) * factor - 0.5, 1e-9);
      EXPECT_NEAR(scaled.y(), (uv.y() + 0.5) * factor - 0.5, 1e-9);
      const Vector2d raw = c.distort(uv), raw_scaled = r.distort(scaled);
      EXPECT_NEAR(raw_scaled.x(), (raw.x() + 0.5) * factor - 0.5, 1e-9);
      EXPECT_NEAR(raw_scaled.y(), (raw.y() + 0.5) * factor - 0.5, 1e-9);
    }

  const Camera odd = plain().resized(0.3333);  // sizes are whole: each axis has its own exact factor
  EXPECT_EQ(odd.width, 213);
  EXPECT_EQ(odd.height, 160);
  EXPECT_NEAR(odd.fx, 620 * 213 / 640.0, 1e-12);
  EXPECT_NEAR(odd.fy, 615 * 160 / 480.0, 1e-12);
  for (const double factor : {0.0, -1.0, 1e-4, 1e9, kNaN})
    expectRefused([&] { plain().resized(factor); }, {"factor"});
}

TEST(Camera, CheckNamesTheField) {
  plain().check();
  const auto refused = [](const std::string& field, const std::function<void(Camera&)>& spoil) {
    Camera c = plain();
    spoil(c);
    expectRefused([&] { c.check(); }, {field + " = "});
  };
  refused("width", [](Camera& c) { c.width = 0; });
  refused("height", [](Camera& c) { c.height = -3; });
  for (const double bad : {kNaN, kInfinity, 0.0, -600.0, 100.0}) {  // 100 px is below a fifth of 640
    refused("fx", [&](Camera& c) { c.fx = bad; });
    refused("fy", [&](Camera& c) { c.fy = bad; });
  }

  for (const double bad : {kNaN, -1.0, 641.0}) refused("cx", [&](Camera& c) { c.cx = bad; });
  for (const double bad : {kNaN, -1.0, 481.0}) refused("cy", [&](Camera& c) { c.cy = bad; });
  const char* names[] = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  for (int i = 0; i < 8; ++i)
    for (const double bad : {kNaN, kInfinity}) refused(names[i], [&](Camera& c) { c.d[i] = bad; });
  Camera unset;
  expectRefused([&] { unset.check(); }, {"width"});
}

TEST(Camera, DistortionModelsGoByManyNames) {
  for (const char* name : {"plumb_bob", "radtan", "Plumb Bob", "Brown Conrady", "radial-tangential"}) {
    const Camera c = with(name, {-0.1, 0.02, 0.001, -0.002});
    EXPECT_EQ(c.model, DistortionModel::kPlumbBob) << name;
    EXPECT_EQ(c.d[3], -0.002) << name;
  }
  for (const char* name : {"none", "None", "no_distortion", "inverse_brown_conrady"}) {
    EXPECT_FALSE(with(name, {}).distorted()) << name;
    EXPECT_EQ(with(name, {0, 0, 0, 0, 0}).model, DistortionModel::kNone) << name;
  }
  const Camera padded = with("plumb_bob", {-0.03, 0.035, -0.0001, -0.0001, -0.012, 0, 0, 0});
  EXPECT_EQ(padded.model, DistortionModel::kPlumbBob);
  EXPECT_EQ(padded.d[4], -0.012);
}

// OpenCV writes 12 or 14 coefficients; those behind the eighth may be zero, else they are named.
TEST(Camera, ThinPrismAndTiltAreRefusedByName) {
  std::vector<double> d{0.1, -0.2, 0.001, 0.002, 0.03, 0.01, 0.02, 0.03, 0, 0, 0, 0};
  EXPECT_EQ(with("rational_polynomial", d).model, DistortionModel::kRationalPolynomial);
  EXPECT_EQ(with("", d).d[7], 0.03);
  d[9] = 0.004;
  for (const char* name : {"rational_polynomial", "plumb_bob", ""})
    expectRefused([&] { with(name, d); }, {"thin prism terms", "CALIB_THIN_PRISM_MODEL", "image_rect"});
  d.resize(14);
  d[12] = 0.01;
  expectRefused([&] { with("", d); }, {"thin prism and tilt terms"});
  expectRefused([&] { with("thin_prism", {0.1, 0.2}); }, {"'thin_prism'", "not supported"});
  expectRefused([&] { with("THIN_PRISM_FISHEYE", {0.1, 0.2, 0, 0}); }, {"'THIN_PRISM_FISHEYE'"});
}

// A point seen through a window of binned pixels lies where the whole image has it.
TEST(Camera, WindowsKeepRays) {
  const Camera c = plain();
  const Camera part = c.seenThrough({100, 60, 400, 300, 2, 2});
  EXPECT_EQ(part.width, 200);
  EXPECT_EQ(part.height, 150);
  const Vector3d p(0.02, -0.03, 1.3);
  const Vector2d in_part = part.project(p);
  EXPECT_LT((2 * in_part + Vector2d(100.5, 60.5) - c.project(p)).norm(), 1e-9);
  expectRefused([&] { c.seenThrough({400, 0, 300, 300, 1, 1}); }, {"region of interest", "640x480"});
  expectRefused([&] { c.seenThrough({0, 0, 200, 150, 1, 1}); }, {"principal point"});
}

TEST(Camera, EquidistantLensesAreOpenCVsFisheye) {
  Camera c = with("equidistant", {-0.012, 0.004, -0.003, 0.0006});
  c.fx = 205;  // 160 degrees wide
  c.fy = 203;
  std::vector<cv::Point3d> points;
  for (double x = -5; x <= 5; x += 0.5)
    for (double y = -4; y <= 4; y += 0.5) points.push_back({x, y, 1});
  std::vector<cv::Point2d> expected;
  const cv::Matx33d k(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  cv::fisheye::projectPoints(points, expected, cv::Vec3d::all(0), cv::Vec3d::all(0), k,
                             std::vector<double>(c.d.begin(), c.d.begin() + 4));
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector2d ideal = c.project({points[i].x, points[i].y, points[i].z}), raw = c.distort(ideal);
    EXPECT_NEAR(raw.x(), expected[i].x, 1e-9);
    EXPECT_NEAR(raw.y(), expected[i].y, 1e-9);
    EXPECT_LT((c.undistort(raw) - ideal).norm(), 1e-9 * (1 + ideal.norm()));
  }
  EXPECT_NO_THROW(c.check());
}

TEST(Camera, JacobiansAreThoseOfFiniteDifferences) {
  for (const Camera& c : cameras()) {
    for (const Vector2d& uv :
         {Vector2d(12, 7), Vector2d(318.3, 243.7), Vector2d(318.31, 243.7), Vector2d(600, 90)}) {
      const DistortedPixel at = c.distortWithJacobian(uv);
      EXPECT_LT((at.uv_raw - c.distort(uv)).norm(), 1e-12);
      for (int k = 0; k < 2; ++k) {
        const Vector2d step = 1e-3 * Vector2d::Unit(k);
        const Vector2d slope = (c.distort(uv + step) - c.distort(uv - step)) / 2e-3;
        EXPECT_LT((at.jacobian.col(k) - slope).norm(), 1e-7) << uv.transpose();
      }
    }
  }
}

TEST(Camera, LensesThatFoldInsideTheImageAreRefused) {
  for (const Camera& c : cameras()) EXPECT_NO_THROW(c.check());
  Camera wide = with("plumb_bob", {-0.25, 0.05, 0, 0, -0.004});
  EXPECT_NO_THROW(wide.check());  // folds, but outside this image
  wide.width = 1280;
  wide.height = 960;
  wide.fx = wide.fy = 580;
  wide.cx = 640;
  wide.cy = 480;
  expectRefused([&] { wide.check(); }, {"folds over inside the image", "Calibrate"});
  // One that dips between two growing parts, and one of the rational model.
  Camera dip = with("plumb_bob", {-3.2, 4.5, 0, 0, 0});
  dip.fx = dip.fy = 400;
  expectRefused([&] { dip.check(); }, {"folds over"});
  Camera rational = with("rational_polynomial", {0, 0, 0, 0, 0, 8, 0, 0});
  expectRefused([&] { rational.check(); }, {"folds over"});
}

TEST(Camera, DistortionModels) {
  EXPECT_EQ(with("", {}).model, DistortionModel::kNone);
  EXPECT_EQ(with("", {0, 0, 0, 0, 0}).model, DistortionModel::kNone);
  EXPECT_EQ(with("", {-0.1, 0, 0, 0, 0}).model, DistortionModel::kPlumbBob);
  EXPECT_EQ(with("plumb_bob", {}).distorted(), false);
  EXPECT_EQ(with("plumb_bob", {0, 0, 0, 0, 0}).distorted(), false);

  const Camera c = with("rational_polynomial", {1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 0});
  EXPECT_EQ(c.model, DistortionModel::kRationalPolynomial);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(c.d[i], i + 1);
  expectRefused([] { with("plumb_bob", {1, 2, 3, 4, 5, 6}); }, {"plumb_bob", "5", "6"});
  expectRefused(
      [] {
        with("rational_polynomial", {1, 2, 3, 4, 5, 6, 7, 8, 9});
      },
      {"rational_polynomial", "9"});
  expectRefused([] { with("plumb_bob", {0, 0, 0, 0, 0, 0, 0, 1}); }, {"plumb_bob", "rational_polynomial"});
  expectRefused([] { with("none", {-0.1, 0, 0, 0, 0}); }, {"none", "not zero"});
  expectRefused([] { with("inverse_brown_conrady", {0.1, 0, 0, 0, 0}); }, {"inverse_brown_conrady"});
  expectRefused([] { with("omnidirectional", {0.1, 0, 0, 0}); }, {"omnidirectional", "equidistant"});
  expectRefused([] { with("equidistant", {}); }, {"equidistant", "4"});
  expectRefused([] { with("equidistant", {0.1, 0, 0, 0, 0.1}); }, {"equidistant", "5"});
}

}  // namespace
}  // namespace monocular_eye_hand
