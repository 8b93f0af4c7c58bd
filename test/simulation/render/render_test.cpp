#include "monocular_eye_hand/simulation/render/render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "render/pinhole.h"
#include "support/camera.h"
#include "support/refusal.h"

using namespace monocular_eye_hand;

namespace {

Camera distorted() { return withWebcamLens(pinhole()); }

// A bright sheet above a dark table: edges whose place is known, without shading of their own.
Scene sheetScene() {
  Scene scene;
  scene.table.material = {0.1, 0, 20, {}};
  scene.lights.clear();
  scene.ambient = 1;
  scene.objects = {{"sheet",
                    0,
                    std::make_shared<Mesh>(quadMesh(0.16, 0.11)),
                    {expSO3({0.1, -0.15, 0.3}), {0, 0, 0.05}},
                    {0.8, 0, 20, {}}}};
  scene.world_from_camera = lookFrom(-1.3, 1.0, 0.45, {0.01, 0, 0.04}, 0.1);
  return scene;
}

RenderOptions noiseless() {
  RenderOptions options;
  options.samples = 4;
  options.edge_samples = 8;
  options.noise_sigma = 0;
  options.shot_noise = 0;
  options.blur_sigma = 0;
  return options;
}

/// Where the grey level crosses half way along a scan across the edge: the area under the step tells it
/// exactly.
double edgeOffset(const cv::Mat& grey, const Eigen::Vector2d& on_edge, const Eigen::Vector2d& normal) {
  // Along rows or columns, whichever crosses the edge more steeply.
  const bool along_u = std::abs(normal.x()) > std::abs(normal.y());
  const double fixed = along_u ? on_edge.y() : on_edge.x(), start = along_u ? on_edge.x() : on_edge.y();
  const int line = int(std::lround(fixed)), reach = 4, middle = int(std::lround(start));
  const auto value = [&](int k) {
    return double(along_u ? grey.at<uchar>(line, k) : grey.at<uchar>(k, line));
  };
  const double low = value(middle - reach), high = value(middle + reach);
  double sum = 0;
  for (int k = middle - reach; k <= middle + reach; ++k) sum += (value(k) - low) / (high - low);
  const double crossing = middle + reach + 0.5 - sum;
  // The scan line lies at a whole pixel: follow the edge's slope to it.
  const double slope = along_u ? -normal.y() / normal.x() : -normal.x() / normal.y();
  const double expected = start + slope * (line - fixed);
  return (crossing - expected) * std::abs(along_u ? normal.x() : normal.y());
}

/// Signed offsets of the rendered edge from the projected one, over all sides of the sheet.
std::vector<double> sheetOffsets(const Scene& scene, const Camera& camera, const cv::Mat& grey) {
  const Rigid3 camera_from_object = scene.cameraFromObject(0);
  const Mesh& mesh = *scene.objects[0].mesh;
  std::vector<double> offsets;
  const auto pixel = [&](int side, double share) {
    const Eigen::Vector3d p =
        mesh.vertices[side] + share * (mesh.vertices[(side + 1) % 4] - mesh.vertices[side]);
    return camera.distort(camera.project(camera_from_object * p));
  };
  for (int side = 0; side < 4; ++side)
    for (double share = 0.2; share < 0.81; share += 0.01) {
      const Eigen::Vector2d uv = pixel(side, share);
      const Eigen::Vector2d along = (pixel(side, share + 0.005) - pixel(side, share - 0.005)).normalized();
      const Eigen::Vector2d normal(along.y(), -along.x());
      if (uv.x() < 10 || uv.y() < 10 || uv.x() > grey.cols - 10 || uv.y() > grey.rows - 10) continue;
      offsets.push_back(edgeOffset(grey, uv, normal));
    }
  return offsets;
}

void expectExact(const std::vector<double>& offsets) {
  ASSERT_GT(offsets.size(), 200u);
  double mean = 0, worst = 0;
  for (double offset : offsets) {
    mean += offset / double(offsets.size());
    worst = std::max(worst, std::abs(offset));
  }
  EXPECT_LT(std::abs(mean), 0.01);
  EXPECT_LT(worst, 0.1);
}

}  // namespace

TEST(Render, EdgesLieWhereTheCameraProjectsThem) {
  const Scene scene = sheetScene();
  expectExact(sheetOffsets(scene, pinhole(), renderScene(scene, pinhole(), noiseless()).grey));
}

TEST(Render, DistortedEdgesLieWhereTheLensPutsThem) {
  Scene scene = sheetScene();
  scene.world_from_camera = lookFrom(-1.3, 1.0, 0.36, {0.05, 0.02, 0.04}, 0.1);
  const cv::Mat grey = renderScene(scene, distorted(), noiseless()).grey;
  expectExact(sheetOffsets(scene, distorted(), grey));
  // The lens matters here: the same picture read with the pinhole is pixels off.
  double worst = 0;
  for (double offset : sheetOffsets(scene, pinhole(), grey)) worst = std::max(worst, std::abs(offset));
  EXPECT_GT(worst, 1.0);
}

TEST(Render, CoarseFirstSamplesDoNotMoveEdges) {
  RenderOptions options = noiseless();
  options.samples = 2;
  options.edge_samples = 4;
  const Scene scene = sheetScene();
  const std::vector<double> offsets =
      sheetOffsets(scene, pinhole(), renderScene(scene, pinhole(), options).grey);
  double mean = 0;
  for (double offset : offsets) mean += offset / double(offsets.size());
  EXPECT_LT(std::abs(mean), 0.02);
}

TEST(Render, IdsAndDepthAgreeWithProjection) {
  const Scene scene = sheetScene();
  const Camera camera = distorted();
  const RenderedImage image = renderScene(scene, camera, noiseless());
  const Rigid3 camera_from_object = scene.cameraFromObject(0);
  int inside = 0;
  for (double x = -0.07; x < 0.071; x += 0.01)
    for (double y = -0.045; y < 0.046; y += 0.01) {
      const Eigen::Vector3d p = camera_from_object * Eigen::Vector3d(x, y, 0);
      const Eigen::Vector2d uv = camera.distort(camera.project(p));
      const cv::Point pixel(int(std::lround(uv.x())), int(std::lround(uv.y())));
      ASSERT_TRUE(cv::Rect(0, 0, camera.width, camera.height).contains(pixel));
      EXPECT_EQ(image.ids.at<short>(pixel), 0);
      EXPECT_NEAR(image.depth.at<float>(pixel), p.z(), 0.001);
      ++inside;
    }

  EXPECT_GT(inside, 100);
  EXPECT_EQ(image.ids.at<short>(2, 2), kTableId);
  Scene empty = scene;
  empty.table.present = false;
  const RenderedImage bare = renderScene(empty, camera, noiseless());
  EXPECT_EQ(bare.ids.at<short>(2, 2), kNothingId);
  EXPECT_EQ(bare.depth.at<float>(2, 2), 0);
}

TEST(Render, SameArgumentsSamePicture) {
  Scene scene = sheetScene();
  scene.lights = {Light{}};
  const RenderOptions options;
  const cv::Mat once = renderScene(scene, pinhole(), options).grey,
                again = renderScene(scene, pinhole(), options).grey;
  EXPECT_EQ(cv::norm(once, again, cv::NORM_INF), 0);
  RenderOptions other = options;
  other.seed = 2;
  EXPECT_GT(cv::norm(once, renderScene(scene, pinhole(), other).grey, cv::NORM_INF), 0);
}

TEST(Render, VisibleFractionCountsWhatStandsBefore) {
  Scene scene = sheetScene();
  // A second sheet half way to the eye that covers the left half of the first, in object coordinates.
  scene.objects[0].world_from_object = {Eigen::Matrix3d::Identity(), {0, 0, 0.05}};
  scene.world_from_camera = lookAt({0, 0, 0.55}, {0, 0, 0});
  const RenderedImage free = renderScene(scene, pinhole(), noiseless());
  EXPECT_DOUBLE_EQ(free.objects[0].fraction, 1);
  SceneObject cover = scene.objects[0];
  cover.mesh = std::make_shared<Mesh>(quadMesh(0.1, 0.2));
  cover.world_from_object.translation = {-0.05, 0, 0.3};
  scene.objects.push_back(cover);
  const RenderedImage hidden = renderScene(scene, pinhole(), noiseless());
  EXPECT_NEAR(hidden.objects[0].fraction, 0.5, 0.01);
  EXPECT_EQ(hidden.objects[0].pixels_alone, free.objects[0].pixels_alone);
  EXPECT_EQ(hidden.objects[0].pixels_visible, cv::countNonZero(hidden.ids == 0));
}

TEST(Render, WhatTheBorderCutsOffIsNotVisible) {
  Scene scene = sheetScene();
  scene.objects[0].world_from_object = {Eigen::Matrix3d::Identity(), {0, 0, 0.05}};
  const Eigen::Vector3d eye(0, 0, 0.55);
  for (const Camera& camera : {pinhole(), distorted()}) {
    // The sheet's middle on the image's left border.
    const double u = (camera.undistort({-0.5, 119.5}).x() - camera.cx) / camera.fx;
    scene.world_from_camera = lookAt(eye, {0, 0, 0});
    scene.world_from_camera.translation -= scene.world_from_camera.rotation.col(0) * u * 0.5;
    const RenderedImage image = renderScene(scene, camera, noiseless());
    // The lens shows the inner half smaller than a rectified pixel, in which the outer half is counted.
    EXPECT_NEAR(image.objects[0].fraction, 0.5, camera.distorted() ? 0.08 : 0.01);
  }
}

TEST(Render, ShadowsFallOppositeTheLight) {
  Scene scene;
  scene.table.material = {0.6, 0, 20, {}};
  scene.ambient = 0.2;
  scene.objects = {{"box", 0, std::make_shared<Mesh>(boxMesh({0.04, 0.04, 0.06})), {}, {0.6, 0, 20, {}}}};
  scene.lights = {{{-0.8, 0, 0.8}, 0.05, 1.0}};
  scene.world_from_camera = lookAt({0, -0.02, 0.6}, {0, 0, 0});
  RenderOptions options = noiseless();
  const RenderedImage with = renderScene(scene, pinhole(), options);

  const auto grey = [&](const RenderedImage& image, double x, double y) {
    const Eigen::Vector2d uv =
        pinhole().project(scene.world_from_camera.inverse() * Eigen::Vector3d(x, y, 0));
    return int(image.grey.at<uchar>(int(std::lround(uv.y())), int(std::lround(uv.x()))));
  };
  EXPECT_LT(grey(with, 0.045, 0), 0.6 * grey(with, -0.06, 0));  // behind the box, seen from the light
  options.shadows = false;
  options.exposure = with.exposure;
  EXPECT_GT(grey(renderScene(scene, pinhole(), options), 0.045, 0), 1.5 * grey(with, 0.045, 0));

  // A larger light makes a softer shadow: its rim takes more pixels between light and dark.
  options.shadows = true;
  const auto rim = [&](double radius) {
    Scene other = scene;
    other.lights[0].radius = radius;
    const RenderedImage image = renderScene(other, pinhole(), options);
    const int dark = grey(image, 0.045, 0), bright = grey(image, 0.045, 0.08);
    int between = 0;
    for (double y = 0; y < 0.08; y += 0.0005) {
      const int value = grey(image, 0.045, y);
      between += value > dark + 0.15 * (bright - dark) && value < bright - 0.15 * (bright - dark);
    }
    return between;
  };
  EXPECT_GT(rim(0.3), 2 * rim(0.01));
}

TEST(Render, NoiseHasItsSigmaAndBlurSoftens) {
  Scene scene = sheetScene();
  scene.objects.clear();
  scene.table.half_width = scene.table.half_depth = 3;
  RenderOptions options = noiseless();
  options.noise_sigma = 2;
  cv::Scalar mean, deviation;
  cv::meanStdDev(renderScene(scene, pinhole(), options).grey, mean, deviation);
  EXPECT_NEAR(mean[0], 255 * options.mean, 0.3);
  EXPECT_NEAR(deviation[0], std::sqrt(4 + 1 / 12.0), 0.05);  // and rounding

  const Scene sheet = sheetScene();
  const auto steepest = [&](double blur) {
    RenderOptions soft = noiseless();
    soft.blur_sigma = blur;
    cv::Mat derivative;
    cv::Sobel(renderScene(sheet, pinhole(), soft).grey, derivative, CV_32F, 1, 0);
    return cv::norm(derivative, cv::NORM_INF);
  };
  EXPECT_LT(steepest(2.0), 0.5 * steepest(0));
}

TEST(Render, AmbientOcclusionDarkensContacts) {
  Scene scene;
  scene.ambient = 1;
  scene.lights.clear();
  scene.objects = {{"box", 0, std::make_shared<Mesh>(boxMesh({0.06, 0.06, 0.06})), {}, {0.6, 0, 20, {}}}};
  scene.world_from_camera = lookAt({0, -0.35, 0.4}, {0, 0, 0});
  RenderOptions options = noiseless();
  options.samples = 6;
  options.ambient_occlusion = true;
  const RenderedImage image = renderScene(scene, pinhole(), options);
  const auto grey = [&](double y) {
    const Eigen::Vector2d uv =
        pinhole().project(scene.world_from_camera.inverse() * Eigen::Vector3d(0, y, 0));
    const cv::Point pixel(int(std::lround(uv.x())), int(std::lround(uv.y())));
    EXPECT_TRUE(cv::Rect({0, 0}, image.grey.size()).contains(pixel)) << pixel;
    return int(image.grey.at<uchar>(pixel));
  };
  EXPECT_LT(grey(-0.034), 0.75 * grey(-0.13));
}

TEST(Render, BadInputIsNamed) {
  Scene scene = sheetScene();
  RenderOptions options;
  options.samples = 0;
  EXPECT_THROW(renderScene(scene, pinhole(), options), BadInput);
  EXPECT_THAT(refusal([&] { options.check(); }), testing::HasSubstr("samples = 0"));
  Camera camera = pinhole();
  camera.fx = 0;
  EXPECT_THROW(renderScene(scene, camera), BadInput);
  scene.objects[0].mesh.reset();
  EXPECT_THROW(renderScene(scene, pinhole()), BadInput);
}
