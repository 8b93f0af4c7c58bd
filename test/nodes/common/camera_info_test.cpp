#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "nodes/common/camera_info.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

sensor_msgs::CameraInfo goodInfo() {
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.distortion_model = "plumb_bob";
  info.D = {-0.28, 0.08, 0.001, -0.0005, 0.01};
  info.K = {700, 0, 320.5, 0, 710, 240.25, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {650, 0, 315, 0, 0, 660, 235, 0, 0, 0, 1, 0};
  return info;
}

std::string refusal(const sensor_msgs::CameraInfo& info, ImageKind kind = ImageKind::kRaw, int width = 640,
                    int height = 480) {
  try {
    cameraFromInfo(info, kind, width, height);
  } catch (const BadCameraInfo& e) {
    return e.what();
  }
  return "accepted";
}

TEST(CameraInfo, RawImageHasKAndD) {
  const Camera camera = cameraFromInfo(goodInfo(), ImageKind::kRaw, 640, 480);
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_DOUBLE_EQ(camera.fx, 700);
  EXPECT_DOUBLE_EQ(camera.fy, 710);
  EXPECT_DOUBLE_EQ(camera.cx, 320.5);
  EXPECT_DOUBLE_EQ(camera.cy, 240.25);
  EXPECT_EQ(camera.model, DistortionModel::kPlumbBob);
  EXPECT_DOUBLE_EQ(camera.d[0], -0.28);
  EXPECT_DOUBLE_EQ(camera.d[4], 0.01);
}

TEST(CameraInfo, RectifiedImageHasPAndNoDistortion) {
  const Camera camera = cameraFromInfo(goodInfo(), ImageKind::kRectified, 640, 480);
  EXPECT_DOUBLE_EQ(camera.fx, 650);
  EXPECT_DOUBLE_EQ(camera.fy, 660);
  EXPECT_DOUBLE_EQ(camera.cx, 315);
  EXPECT_DOUBLE_EQ(camera.cy, 235);
  EXPECT_FALSE(camera.distorted());
}

TEST(CameraInfo, NoDistortionMayBeEmpty) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.D.clear();
  EXPECT_FALSE(cameraFromInfo(info, ImageKind::kRaw, 640, 480).distorted());
  info.D.assign(5, 0.0);
  EXPECT_FALSE(cameraFromInfo(info, ImageKind::kRaw, 640, 480).distorted());
}

TEST(CameraInfo, RationalPolynomial) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.distortion_model = "rational_polynomial";
  info.D = {0.5, 0.1, 0.0005, -0.0003, 0.002, 0.85, 0.25, 0.01};
  const Camera camera = cameraFromInfo(info, ImageKind::kRaw, 640, 480);
  EXPECT_EQ(camera.model, DistortionModel::kRationalPolynomial);
  EXPECT_DOUBLE_EQ(camera.d[7], 0.01);
}

// A point at the centre of a 2x2 block of the full image lies at an integer pixel of the binned one.
TEST(CameraInfo, BinningMapsBlockCentresToPixels) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.D.clear();
  const Camera full = cameraFromInfo(info, ImageKind::kRaw, 640, 480);
  info.binning_x = info.binning_y = 2;
  const Camera binned = cameraFromInfo(info, ImageKind::kRaw, 320, 240);
  const Eigen::Vector3d p(0.11, -0.07, 1.3);
  const Eigen::Vector2d in_full = full.project(p), in_binned = binned.project(p);
  EXPECT_NEAR(in_full.x(), 2 * in_binned.x() + 0.5, 1e-9);
  EXPECT_NEAR(in_full.y(), 2 * in_binned.y() + 0.5, 1e-9);
}

TEST(CameraInfo, RegionOfInterestShiftsThePrincipalPoint) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.D.clear();
  const Camera full = cameraFromInfo(info, ImageKind::kRaw, 640, 480);
  info.roi.x_offset = 100;
  info.roi.y_offset = 60;
  info.roi.width = 400;
  info.roi.height = 300;
  const Camera part = cameraFromInfo(info, ImageKind::kRaw, 400, 300);
  const Eigen::Vector3d p(0.11, -0.07, 1.3);
  EXPECT_NEAR((full.project(p) - part.project(p) - Eigen::Vector2d(100, 60)).norm(), 0, 1e-9);
  EXPECT_EQ(part.width, 400);
}

TEST(CameraInfo, KnowsTheSizeOfItsImage) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.roi.x_offset = 100;
  info.roi.y_offset = 60;
  info.roi.width = 400;
  info.roi.height = 300;
  info.binning_x = info.binning_y = 2;
  const Camera camera = cameraFromInfo(info, ImageKind::kRaw);
  const Camera expected = cameraFromInfo(info, ImageKind::kRaw, 200, 150);
  EXPECT_EQ(camera.width, 200);
  EXPECT_EQ(camera.height, 150);
  EXPECT_EQ(camera.fx, expected.fx);
  EXPECT_EQ(camera.cx, expected.cx);
  info.width = 0;
  EXPECT_THROW(cameraFromInfo(info, ImageKind::kRaw), BadCameraInfo);
}

TEST(CameraInfo, RegionAndBinningTogether) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.roi.x_offset = 100;
  info.roi.y_offset = 60;
  info.roi.width = 400;
  info.roi.height = 300;
  info.binning_x = info.binning_y = 2;
  const Camera camera = cameraFromInfo(info, ImageKind::kRaw, 200, 150);
  EXPECT_DOUBLE_EQ(camera.fx, 350);
  EXPECT_DOUBLE_EQ(camera.cx, (320.5 - 100 + 0.5) / 2 - 0.5);
  EXPECT_THAT(refusal(info, ImageKind::kRaw, 400, 300), HasSubstr("200x150 (binned 2x2 from 400x300)"));
}

TEST(CameraInfo, RefusesRegionsThatCannotBe) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.roi.x_offset = 400;
  info.roi.width = 400;
  info.roi.height = 300;
  EXPECT_THAT(refusal(info, ImageKind::kRaw, 400, 300), HasSubstr("leaves the camera's 640x480 image"));
  info.roi.x_offset = 0;
  info.roi.width = 200;
  info.roi.height = 150;
  EXPECT_THAT(refusal(info, ImageKind::kRaw, 200, 150), HasSubstr("principal point"));
  info = goodInfo();
  info.roi.width = 640;
  info.roi.height = 480;
  info.roi.do_rectify = true;
  EXPECT_THAT(refusal(info, ImageKind::kRectified), HasSubstr("do_rectify"));
  EXPECT_EQ(refusal(info, ImageKind::kRaw), "accepted");
}

TEST(CameraInfo, RefusesMissingCalibration) {
  EXPECT_THAT(refusal(sensor_msgs::CameraInfo()), HasSubstr("width or height is zero"));
  sensor_msgs::CameraInfo info = goodInfo();
  info.K.fill(0);
  EXPECT_THAT(refusal(info), HasSubstr("K is all zero, which means uncalibrated"));
  info = goodInfo();
  info.P.fill(0);
  EXPECT_THAT(refusal(info, ImageKind::kRectified), HasSubstr("P is all zero"));
  EXPECT_EQ(refusal(info, ImageKind::kRaw), "accepted");  // P does not matter there
}

TEST(CameraInfo, RefusesImplausibleFocalLength) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.K[0] = 1;  // what a publisher invents that knows no calibration
  EXPECT_THAT(refusal(info), HasSubstr("fx = 1"));
  info = goodInfo();
  info.K[0] = 640 / 5.0 - 0.1;
  EXPECT_THAT(refusal(info), HasSubstr("fifth"));
  info.K[0] = 640 / 5.0;
  EXPECT_EQ(refusal(info), "accepted");
  info = goodInfo();
  info.K[4] = 0;
  EXPECT_THAT(refusal(info), HasSubstr("fy = 0"));
  info = goodInfo();
  info.P[0] = -650;
  EXPECT_THAT(refusal(info, ImageKind::kRectified), HasSubstr("fx = -650"));
  info = goodInfo();
  info.K[2] = 900;
  EXPECT_THAT(refusal(info), HasSubstr("cx = 900"));
}

TEST(CameraInfo, RefusesWhatIsNotFinite) {
  for (const ImageKind kind : {ImageKind::kRaw, ImageKind::kRectified}) {
    sensor_msgs::CameraInfo info = goodInfo();
    info.K[4] = kNaN;
    EXPECT_THAT(refusal(info, kind), HasSubstr("K[4] = nan is not finite"));
    info = goodInfo();
    info.D[2] = kNaN;
    EXPECT_THAT(refusal(info, kind), HasSubstr("D[2] = nan is not finite"));
    info = goodInfo();
    info.P[5] = std::numeric_limits<double>::infinity();
    EXPECT_THAT(refusal(info, kind), HasSubstr("P[5] = inf is not finite"));
    info = goodInfo();
    info.R[8] = kNaN;
    EXPECT_THAT(refusal(info, kind), HasSubstr("R[8]"));
  }
}

TEST(CameraInfo, RefusesOtherSizes) {
  EXPECT_THAT(refusal(goodInfo(), ImageKind::kRaw, 320, 240),
              HasSubstr("the image is 320x240 but camera_info describes 640x480"));
}

TEST(CameraInfo, RefusesOtherLensModels) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.distortion_model = "omnidirectional";
  info.D = {0.1, 0.1, 0.1, 0.1};
  EXPECT_THAT(
      refusal(info),
      HasSubstr("'omnidirectional' is not supported; known: plumb_bob, rational_polynomial, equidistant"));
  EXPECT_EQ(refusal(info, ImageKind::kRectified), "accepted");
}

TEST(CameraInfo, OfAFileKeepsItsProjection) {
  CameraFile file;
  file.camera = Camera{640, 480, 600, 610, 300.5, 239.5, DistortionModel::kNone, {}};
  EXPECT_EQ(toCameraInfo(file).P[0], 600);
  file.projection = {650, 0, 310, 0, 0, 650, 240, 0, 0, 0, 1, 0};
  EXPECT_EQ(toCameraInfo(file).P[0], 650);
  EXPECT_EQ(toCameraInfo(file).K[0], 600);
}

TEST(CameraInfo, RefusesTheSecondStereoCamera) {
  sensor_msgs::CameraInfo info = goodInfo();
  info.P[3] = -60;
  EXPECT_THAT(refusal(info, ImageKind::kRectified), HasSubstr("second camera of a stereo pair"));
  EXPECT_EQ(refusal(info, ImageKind::kRaw), "accepted");
}

TEST(CameraInfo, OfACameraGivesThatCamera) {
  Camera camera{640, 480, 600, 610, 300.5, 239.5, DistortionModel::kNone, {}};
  const std::vector<std::pair<std::string, std::vector<double>>> lenses{
      {"", {}},
      {"plumb_bob", {-0.11, 0.06, 0.0006, -0.0004, 0.01}},
      {"equidistant", {-0.02, 0.01, 0.003, -0.001}},
      {"rational_polynomial", {0.1, -0.2, 0.001, 0.002, 0.03, 0.01, 0.02, 0.03}}};
  for (const auto& [model, coefficients] : lenses) {
    setDistortion(&camera, model, coefficients.data(), coefficients.size());
    const sensor_msgs::CameraInfo info = toCameraInfo(camera);
    const Camera raw = cameraFromInfo(info, ImageKind::kRaw, 640, 480);
    EXPECT_EQ(raw.intrinsics(), camera.intrinsics()) << model;
    EXPECT_EQ(raw.d, camera.d) << model;
    EXPECT_EQ(raw.distorted(), camera.distorted()) << model;
    const Camera rectified = cameraFromInfo(info, ImageKind::kRectified, 640, 480);
    EXPECT_EQ(rectified.intrinsics(), camera.intrinsics()) << model;
    EXPECT_FALSE(rectified.distorted()) << model;
  }
}

}  // namespace
}  // namespace monocular_eye_hand
