#include "monocular_eye_hand/geometry/camera.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Camera plain() {
  Camera c;
  c.width = 640, c.height = 480;
  c.fx = 620, c.fy = 615, c.cx = 318.3, c.cy = 243.7;
  return c;
}

Camera with(const std::string& model, const std::vector<double>& d) {
  Camera c = plain();
  setDistortion(&c, model, d.data(), d.size());
  return c;
}

std::vector<Camera> cameras() {
  return {plain(), with("plumb_bob", {-0.28, 0.08, 0.001, -0.0005, 0}),
          with("plumb_bob", {0.12, -0.2, -0.002, 0.001, 0.05}),
          with("plumb_bob", {-0.1, 0.02, 0.0005, 0.0003}),
          with("rational_polynomial", {2.1, 0.9, 0.0004, -0.0003, 0.03, 2.4, 1.5, 0.2})};
}

void expectRefused(const std::function<void()>& call, const std::vector<std::string>& named) {
  try {
    call();
    ADD_FAILURE() << "accepted; expected a message about " << named[0];
  } catch (const BadInput& e) {
    for (const std::string& word : named)
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos)
          << "'" << word << "' not in: " << e.what();
  }
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
  expectRefused([] { with("equidistant", {0.1, 0, 0, 0}); }, {"equidistant", "plumb_bob"});
  expectRefused([] { with("equidistant", {}); }, {"equidistant"});
}

class CameraFile : public ::testing::Test {
 protected:
  void TearDown() override { std::remove(path_.c_str()); }
  std::string write(const std::string& text) {
    std::ofstream(path_) << text;
    return path_;
  }
  std::string path_ = ::testing::TempDir() + "monocular_eye_hand_camera_" +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml";
};

const char kGood[] = R"(image_width: 640
image_height: 480
camera_name: left
camera_matrix:
  rows: 3
  cols: 3
  data: [620.0, 0.0, 318.3, 0.0, 615.0, 243.7, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.28, 0.08, 0.001, -0.0005, 0.0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
)";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(CameraFile, Good) {
  const Camera c = loadCamera(write(kGood));
  EXPECT_EQ(c.width, 640);
  EXPECT_EQ(c.height, 480);
  EXPECT_EQ(c.fx, 620);
  EXPECT_EQ(c.fy, 615);
  EXPECT_EQ(c.cx, 318.3);
  EXPECT_EQ(c.cy, 243.7);
  EXPECT_EQ(c.model, DistortionModel::kPlumbBob);
  EXPECT_EQ(c.d[0], -0.28);
  EXPECT_EQ(c.d[3], -0.0005);
  const Camera undistorted =
      loadCamera(write(std::string(kGood).substr(0, std::string(kGood).find("distortion_model"))));
  EXPECT_FALSE(undistorted.distorted());
}

TEST_F(CameraFile, BadOnesNameFileAndField) {
  const auto refused = [&](const std::string& text, const std::vector<std::string>& named) {
    std::vector<std::string> all = named;
    all.push_back(path_);
    write(text);
    expectRefused([&] { loadCamera(path_); }, all);
  };
  expectRefused([] { loadCamera("/nowhere/camera.yaml"); }, {"/nowhere/camera.yaml", "cannot be read"});
  refused("", {});
  refused("just text", {});
  refused("[1, 2, 3]", {});
  refused("image_width: [", {});
  refused(replaced("image_width: 640\n", ""), {"image_width", "missing"});
  refused(replaced("image_height: 480\n", ""), {"image_height", "missing"});
  refused(replaced("image_width: 640", "image_width: wide"), {});
  refused(replaced("image_width: 640", "image_width: 0"), {"width"});
  refused(replaced("camera_matrix:", "other_matrix:"), {"camera_matrix", "missing"});
  refused(replaced("620.0, 0.0, ", "620.0, "), {"camera_matrix", "8", "9"});
  refused(replaced("620.0", ".nan"), {"camera_matrix", "finite"});
  refused(replaced("620.0", ".inf"), {"camera_matrix", "finite"});
  refused(replaced("620.0", "f"), {});
  refused(replaced("620.0", "0.0"), {"fx", "calibrate"});
  refused(replaced("620.0", "62.0"), {"fx", "fifth"});
  refused(replaced("318.3", "3183"), {"cx", "outside"});
  refused(replaced("0.0, 0.0, 1.0]", "0.0, 0.0, 2.0]"), {"camera_matrix"});
  refused(replaced("620.0, 0.0, 318.3, 0.0, 615.0, 243.7, 0.0, 0.0, 1.0",
                   "620, 0, 0, 0, 615, 0, 318.3, 243.7, 1"),
          {"camera_matrix"});  // transposed
  refused(replaced("-0.28", ".nan"), {"distortion_coefficients", "finite"});
  refused(replaced("plumb_bob", "fisheye"), {"fisheye", "plumb_bob"});
  refused(replaced("-0.0005, 0.0]", "-0.0005, 0.0, 0.1]"), {"plumb_bob", "6"});
}

}  // namespace
}  // namespace monocular_eye_hand
