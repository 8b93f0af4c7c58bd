#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "monocular_eye_hand/io/image_calibration.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ImageCalibration goodInfo() {
  ImageCalibration calibration;
  calibration.width = 640;
  calibration.height = 480;
  calibration.distortion_model = "plumb_bob";
  calibration.d = {-0.28, 0.08, 0.001, -0.0005, 0.01};
  calibration.k = {700, 0, 320.5, 0, 710, 240.25, 0, 0, 1};
  calibration.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  calibration.p = {650, 0, 315, 0, 0, 660, 235, 0, 0, 0, 1, 0};
  return calibration;
}

std::string refusal(const ImageCalibration& calibration, ImageKind kind = ImageKind::kRaw, int width = 640,
                    int height = 480) {
  try {
    cameraOf(calibration, kind, width, height);
  } catch (const BadCameraInfo& e) {
    return e.what();
  }
  return "accepted";
}

TEST(ImageCalibration, RawImageHasKAndD) {
  const Camera camera = cameraOf(goodInfo(), ImageKind::kRaw, 640, 480);
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

TEST(ImageCalibration, RectifiedImageHasPAndNoDistortion) {
  const Camera camera = cameraOf(goodInfo(), ImageKind::kRectified, 640, 480);
  EXPECT_DOUBLE_EQ(camera.fx, 650);
  EXPECT_DOUBLE_EQ(camera.fy, 660);
  EXPECT_DOUBLE_EQ(camera.cx, 315);
  EXPECT_DOUBLE_EQ(camera.cy, 235);
  EXPECT_FALSE(camera.distorted());
}

TEST(ImageCalibration, NoDistortionMayBeEmpty) {
  ImageCalibration calibration = goodInfo();
  calibration.d.clear();
  EXPECT_FALSE(cameraOf(calibration, ImageKind::kRaw, 640, 480).distorted());
  calibration.d.assign(5, 0.0);
  EXPECT_FALSE(cameraOf(calibration, ImageKind::kRaw, 640, 480).distorted());
}

TEST(ImageCalibration, RationalPolynomial) {
  ImageCalibration calibration = goodInfo();
  calibration.distortion_model = "rational_polynomial";
  calibration.d = {0.5, 0.1, 0.0005, -0.0003, 0.002, 0.85, 0.25, 0.01};
  const Camera camera = cameraOf(calibration, ImageKind::kRaw, 640, 480);
  EXPECT_EQ(camera.model, DistortionModel::kRationalPolynomial);
  EXPECT_DOUBLE_EQ(camera.d[7], 0.01);
}

// A point at the centre of a 2x2 block of the full image lies at an integer pixel of the binned one.
TEST(ImageCalibration, BinningMapsBlockCentresToPixels) {
  ImageCalibration calibration = goodInfo();
  calibration.d.clear();
  const Camera full = cameraOf(calibration, ImageKind::kRaw, 640, 480);
  calibration.binning_x = calibration.binning_y = 2;
  const Camera binned = cameraOf(calibration, ImageKind::kRaw, 320, 240);
  const Eigen::Vector3d p(0.11, -0.07, 1.3);
  const Eigen::Vector2d in_full = full.project(p), in_binned = binned.project(p);
  EXPECT_NEAR(in_full.x(), 2 * in_binned.x() + 0.5, 1e-9);
  EXPECT_NEAR(in_full.y(), 2 * in_binned.y() + 0.5, 1e-9);
}

TEST(ImageCalibration, RegionOfInterestShiftsThePrincipalPoint) {
  ImageCalibration calibration = goodInfo();
  calibration.d.clear();
  const Camera full = cameraOf(calibration, ImageKind::kRaw, 640, 480);
  calibration.region.x = 100;
  calibration.region.y = 60;
  calibration.region.width = 400;
  calibration.region.height = 300;
  const Camera part = cameraOf(calibration, ImageKind::kRaw, 400, 300);
  const Eigen::Vector3d p(0.11, -0.07, 1.3);
  EXPECT_NEAR((full.project(p) - part.project(p) - Eigen::Vector2d(100, 60)).norm(), 0, 1e-9);
  EXPECT_EQ(part.width, 400);
}

TEST(ImageCalibration, KnowsTheSizeOfItsImage) {
  ImageCalibration calibration = goodInfo();
  calibration.region.x = 100;
  calibration.region.y = 60;
  calibration.region.width = 400;
  calibration.region.height = 300;
  calibration.binning_x = calibration.binning_y = 2;
  const Camera camera = cameraOf(calibration, ImageKind::kRaw);
  const Camera expected = cameraOf(calibration, ImageKind::kRaw, 200, 150);
  EXPECT_EQ(camera.width, 200);
  EXPECT_EQ(camera.height, 150);
  EXPECT_EQ(camera.fx, expected.fx);
  EXPECT_EQ(camera.cx, expected.cx);
  calibration.width = 0;
  EXPECT_THROW(cameraOf(calibration, ImageKind::kRaw), BadCameraInfo);
}

TEST(ImageCalibration, RegionAndBinningTogether) {
  ImageCalibration calibration = goodInfo();
  calibration.region.x = 100;
  calibration.region.y = 60;
  calibration.region.width = 400;
  calibration.region.height = 300;
  calibration.binning_x = calibration.binning_y = 2;
  const Camera camera = cameraOf(calibration, ImageKind::kRaw, 200, 150);
  EXPECT_DOUBLE_EQ(camera.fx, 350);
  EXPECT_DOUBLE_EQ(camera.cx, (320.5 - 100 + 0.5) / 2 - 0.5);
  EXPECT_THAT(refusal(calibration, ImageKind::kRaw, 400, 300),
              HasSubstr("200x150 (binned 2x2 from 400x300)"));
}

TEST(ImageCalibration, RefusesRegionsThatCannotBe) {
  ImageCalibration calibration = goodInfo();
  calibration.region.x = 400;
  calibration.region.width = 400;
  calibration.region.height = 300;
  EXPECT_THAT(refusal(calibration, ImageKind::kRaw, 400, 300),
              HasSubstr("leaves the camera's 640x480 image"));
  calibration.region.x = 0;
  calibration.region.width = 200;
  calibration.region.height = 150;
  EXPECT_THAT(refusal(calibration, ImageKind::kRaw, 200, 150), HasSubstr("principal point"));
  calibration = goodInfo();
  calibration.region.width = 640;
  calibration.region.height = 480;
  calibration.region.do_rectify = true;
  EXPECT_THAT(refusal(calibration, ImageKind::kRectified), HasSubstr("do_rectify"));
  EXPECT_EQ(refusal(calibration, ImageKind::kRaw), "accepted");
}

TEST(ImageCalibration, RefusesMissingCalibration) {
  EXPECT_THAT(refusal(ImageCalibration()), HasSubstr("width or height is zero"));
  ImageCalibration calibration = goodInfo();
  calibration.k.fill(0);
  EXPECT_THAT(refusal(calibration), HasSubstr("K is all zero, which means uncalibrated"));
  calibration = goodInfo();
  calibration.p.fill(0);
  EXPECT_THAT(refusal(calibration, ImageKind::kRectified), HasSubstr("P is all zero"));
  EXPECT_EQ(refusal(calibration, ImageKind::kRaw), "accepted");  // P does not matter there
}

TEST(ImageCalibration, RefusesImplausibleFocalLength) {
  ImageCalibration calibration = goodInfo();
  calibration.k[0] = 1;  // what a publisher invents that knows no calibration
  EXPECT_THAT(refusal(calibration), HasSubstr("fx = 1"));
  calibration = goodInfo();
  calibration.k[0] = 640 / 5.0 - 0.1;
  EXPECT_THAT(refusal(calibration), HasSubstr("fifth"));
  calibration.k[0] = 640 / 5.0;
  EXPECT_EQ(refusal(calibration), "accepted");
  calibration = goodInfo();
  calibration.k[4] = 0;
  EXPECT_THAT(refusal(calibration), HasSubstr("fy = 0"));
  calibration = goodInfo();
  calibration.p[0] = -650;
  EXPECT_THAT(refusal(calibration, ImageKind::kRectified), HasSubstr("fx = -650"));
  calibration = goodInfo();
  calibration.k[2] = 900;
  EXPECT_THAT(refusal(calibration), HasSubstr("cx = 900"));
}

TEST(ImageCalibration, RefusesWhatIsNotFinite) {
  for (const ImageKind kind : {ImageKind::kRaw, ImageKind::kRectified}) {
    ImageCalibration calibration = goodInfo();
    calibration.k[4] = kNaN;
    EXPECT_THAT(refusal(calibration, kind), HasSubstr("K[4] = nan is not finite"));
    calibration = goodInfo();
    calibration.d[2] = kNaN;
    EXPECT_THAT(refusal(calibration, kind), HasSubstr("D[2] = nan is not finite"));
    calibration = goodInfo();
    calibration.p[5] = std::numeric_limits<double>::infinity();
    EXPECT_THAT(refusal(calibration, kind), HasSubstr("P[5] = inf is not finite"));
    calibration = goodInfo();
    calibration.r[8] = kNaN;
    EXPECT_THAT(refusal(calibration, kind), HasSubstr("R[8]"));
  }
}

TEST(ImageCalibration, RefusesOtherSizes) {
  EXPECT_THAT(refusal(goodInfo(), ImageKind::kRaw, 320, 240),
              HasSubstr("the image is 320x240 but camera_info describes 640x480"));
}

TEST(ImageCalibration, RefusesOtherLensModels) {
  ImageCalibration calibration = goodInfo();
  calibration.distortion_model = "omnidirectional";
  calibration.d = {0.1, 0.1, 0.1, 0.1};
  EXPECT_THAT(
      refusal(calibration),
      HasSubstr("'omnidirectional' is not supported; known: plumb_bob, rational_polynomial, equidistant"));
  EXPECT_EQ(refusal(calibration, ImageKind::kRectified), "accepted");
}

TEST(ImageCalibration, OfAFileKeepsItsProjection) {
  CameraFile file;
  file.camera = Camera{640, 480, 600, 610, 300.5, 239.5, DistortionModel::kNone, {}};
  EXPECT_EQ(calibrationOf(file).p[0], 600);
  file.projection = {650, 0, 310, 0, 0, 650, 240, 0, 0, 0, 1, 0};
  EXPECT_EQ(calibrationOf(file).p[0], 650);
  EXPECT_EQ(calibrationOf(file).k[0], 600);
}

TEST(ImageCalibration, RefusesTheSecondStereoCamera) {
  ImageCalibration calibration = goodInfo();
  calibration.p[3] = -60;
  EXPECT_THAT(refusal(calibration, ImageKind::kRectified), HasSubstr("second camera of a stereo pair"));
  EXPECT_EQ(refusal(calibration, ImageKind::kRaw), "accepted");
}

TEST(ImageCalibration, OfACameraGivesThatCamera) {
  Camera camera{640, 480, 600, 610, 300.5, 239.5, DistortionModel::kNone, {}};
  const std::vector<std::pair<std::string, std::vector<double>>> lenses{
      {"", {}},
      {"plumb_bob", {-0.11, 0.06, 0.0006, -0.0004, 0.01}},
      {"equidistant", {-0.02, 0.01, 0.003, -0.001}},
      {"rational_polynomial", {0.1, -0.2, 0.001, 0.002, 0.03, 0.01, 0.02, 0.03}}};
  for (const auto& [model, coefficients] : lenses) {
    setDistortion(&camera, model, coefficients.data(), coefficients.size());
    const ImageCalibration calibration = calibrationOf(camera);
    const Camera raw = cameraOf(calibration, ImageKind::kRaw, 640, 480);
    EXPECT_EQ(raw.intrinsics(), camera.intrinsics()) << model;
    EXPECT_EQ(raw.d, camera.d) << model;
    EXPECT_EQ(raw.distorted(), camera.distorted()) << model;
    const Camera rectified = cameraOf(calibration, ImageKind::kRectified, 640, 480);
    EXPECT_EQ(rectified.intrinsics(), camera.intrinsics()) << model;
    EXPECT_FALSE(rectified.distorted()) << model;
  }
}

}  // namespace
}  // namespace monocular_eye_hand
