#include "monocular_eye_hand/evaluation/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "support/camera.h"

namespace monocular_eye_hand {
namespace {

Camera withoutLens() { return {320, 240, 350, 351, 160.2, 118.7, DistortionModel::kNone, {}}; }

Camera lens() { return withWebcamLens(withoutLens()); }

// A smooth blob; its centre is found again by moments.
cv::Mat blob(const Camera& camera, const Eigen::Vector2d& centre) {
  cv::Mat image(camera.height, camera.width, CV_8UC1);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u)
      image.at<uchar>(v, u) =
          cv::saturate_cast<uchar>(20 + 200 * std::exp(-(Eigen::Vector2d(u, v) - centre).squaredNorm() / 18));
  return image;
}

Eigen::Vector2d centroid(const cv::Mat& image) {
  cv::Mat above;
  cv::threshold(image, above, 60, 0, cv::THRESH_TOZERO);
  const cv::Moments m = cv::moments(above);
  return {m.m10 / m.m00, m.m01 / m.m00};
}

TEST(LensWarp, APointLandsWhereTheLensPutsIt) {
  LensWarp warp;
  for (const Eigen::Vector2d& uv :
       {Eigen::Vector2d(60, 50), Eigen::Vector2d(250, 180), Eigen::Vector2d(160, 120)}) {
    const cv::Mat raw = warp.apply(blob(withoutLens(), uv), lens());
    EXPECT_LT((centroid(raw) - lens().distort(uv)).norm(), 0.15) << uv.transpose();
  }
  // ... which is a long way from where it was.
  EXPECT_GT((lens().distort({60, 50}) - Eigen::Vector2d(60, 50)).norm(), 3);
}

TEST(LensWarp, NoDistortionChangesNothing) {
  LensWarp warp;
  const cv::Mat ideal = blob(withoutLens(), {100, 100});
  EXPECT_EQ(cv::norm(warp.apply(ideal, withoutLens()), ideal, cv::NORM_INF), 0);
}

TEST(LensWarp, AnotherLensGetsAnotherMap) {
  LensWarp warp;
  const cv::Mat ideal = blob(withoutLens(), {60, 50});
  const cv::Mat first = warp.apply(ideal, lens());
  warp.apply(ideal, withoutLens());
  EXPECT_EQ(cv::norm(warp.apply(ideal, lens()), first, cv::NORM_INF), 0);
}

TEST(LensWarp, TheSizesMustAgree) {
  LensWarp warp;
  EXPECT_THROW(warp.apply(cv::Mat(10, 10, CV_8UC1, cv::Scalar(0)), lens()), BadInput);
}

TEST(Resized, ImageAndCameraAgree) {
  const Eigen::Vector3d p(0.05, -0.1, 1);
  for (double factor : {2.0, 0.5, 1.37}) {
    const CameraImage out = resized({blob(withoutLens(), withoutLens().project(p)), withoutLens()}, factor);
    EXPECT_EQ(out.grey.cols, out.camera.width);
    EXPECT_EQ(out.grey.rows, out.camera.height);
    EXPECT_LT((centroid(out.grey) - out.camera.project(p)).norm(), 0.15 * std::max(1.0, factor)) << factor;
  }
  EXPECT_THROW(resized({blob(withoutLens(), {1, 1}), withoutLens()}, 0), BadInput);
  EXPECT_THROW(resized({blob(withoutLens(), {1, 1}), withoutLens()}, 1e-4), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
