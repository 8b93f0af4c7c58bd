#include "calibration/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "calibration/homography.h"
#include "monocular_eye_hand/geometry/error.h"
#include "session.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

/// A board that stands up in its middle by `warp`, its corners with noise and told to have it, or 0.01 px.
CalibrationView viewFrom(Random& random, const Camera& camera, const Rigid3& camera_from_target, double sigma,
                         const Eigen::Vector2d& warp = {0, 0}) {
  CalibrationView view;
  for (const Eigen::Vector3d& corner : boardCorners()) {
    const Eigen::Vector2d at(corner.x() / (4.5 * 0.025), corner.y() / (3 * 0.025));
    const double rise = warp.dot(Eigen::Vector2d::Ones() - at.cwiseProduct(at));
    const Eigen::Vector2d seen =
        camera.distort(camera.project(camera_from_target * (corner + Eigen::Vector3d(0, 0, rise))));
    if (seen.x() < 0 || seen.y() < 0 || seen.x() > camera.width - 1 || seen.y() > camera.height - 1) continue;
    const Eigen::Vector2d noise(normal(random), normal(random));
    view.points.push_back({corner, seen + sigma * noise, std::max(0.01, sigma)});
  }
  return view;
}

std::vector<CalibrationView> viewsOf(Random& random, const Camera& camera, int count, double sigma,
                                     const Eigen::Vector2d& warp = {0, 0}) {
  std::vector<CalibrationView> views;
  for (int v = 0; v < count; ++v) {
    views.push_back(viewFrom(random, camera, cameraBeforeBoard(random, 0.8), sigma, warp));
    views.back().name = "view " + std::to_string(v);
  }
  return views;
}

Camera cameraWith(const std::string& model, const std::vector<double>& coefficients) {
  Camera camera{1280, 1024, 1402, 1398, 652, 500, DistortionModel::kNone, {}};
  return model.empty() ? camera : withLens(camera, model, coefficients);
}

TEST(CameraCalibration, HomographiesGiveTheFocalLengths) {
  Random random(1);
  const Camera camera{1280, 1024, 1402, 1398, 639.5, 511.5, DistortionModel::kNone, {}};
  std::vector<Eigen::Matrix3d> homographies;
  for (const CalibrationView& view : viewsOf(random, camera, 6, 1e-9))
    homographies.push_back(*homographyOf(view));
  const auto focal = focalLengths(homographies, {639.5, 511.5});
  ASSERT_TRUE(focal.has_value());
  EXPECT_NEAR(focal->x(), 1402, 1e-3);
  EXPECT_NEAR(focal->y(), 1398, 1e-3);
}

TEST(CameraCalibration, ExactViewsGiveTheTruthWithEachLens) {
  Random random(2);
  for (const Camera& camera : {cameraWith("plumb_bob", {-0.2, 0.1, 1e-3, -5e-4, 0.02}),
                               cameraWith("rational_polynomial", {0.4, 0.1, 1e-3, -5e-4, 0.0, 0.6, 0.1, 0.0}),
                               cameraWith("equidistant", {0.02, -0.01, 0.0, 0.0})}) {
    CameraOptions options;
    options.model = distortionName(camera);
    const CameraCalibration result = calibrateCamera(viewsOf(random, camera, 12, 1e-6), 1280, 1024, options);
    EXPECT_NEAR(result.camera.fx, camera.fx, 0.01) << options.model;
    EXPECT_NEAR(result.camera.cy, camera.cy, 0.01) << options.model;
    EXPECT_LT(result.rms, 1e-4) << options.model;
    for (const Eigen::Vector2d& uv :
         {Eigen::Vector2d(20, 30), Eigen::Vector2d(1250, 1000), Eigen::Vector2d(640, 500)})
      EXPECT_LT((result.camera.undistort(uv) - camera.undistort(uv)).norm(), 0.05) << options.model;
  }
}

TEST(CameraCalibration, TheLensIsChosenByWhatItPredicts) {
  Random random(3);
  const Camera barrel = cameraWith("plumb_bob", {-0.25, 0.1, 5e-4, -5e-4, 0});
  EXPECT_EQ(distortionName(calibrateCamera(viewsOf(random, barrel, 15, 0.1), 1280, 1024).camera),
            "plumb_bob");

  Camera fisheye = cameraWith("equidistant", {0.01, -0.005, 0, 0});
  fisheye.fx = fisheye.fy = 420;
  std::vector<CalibrationView> views;
  for (int v = 0; v < 25; ++v) {  // the board all over the image, up to 50 degrees off the axis
    Rigid3 pose = cameraBeforeBoard(random, 0.6);
    pose.translation = 0.3 * Eigen::Vector3d(uniform(random, -0.9, 0.9), uniform(random, -0.7, 0.7), 1);
    views.push_back(viewFrom(random, fisheye, pose, 0.1));
  }
  EXPECT_EQ(distortionName(calibrateCamera(views, 1280, 1024).camera), "equidistant");
}

TEST(CameraCalibration, TheTruthIsAsFarAwayAsTold) {
  constexpr int kRuns = 60;
  Random random(4);
  const Camera camera = cameraWith("plumb_bob", {-0.2, 0.1, 1e-3, -5e-4, 0.0});
  CameraOptions options;
  options.model = "plumb_bob";
  int within = 0;
  for (int run = 0; run < kRuns; ++run) {
    const CameraCalibration result = calibrateCamera(viewsOf(random, camera, 12, 0.15), 1280, 1024, options);
    const double sigma = std::sqrt(result.covariance(0, 0));
    within += std::abs(result.camera.fx - camera.fx) < 1.645 * sigma;
    EXPECT_LT(sigma, 2);
  }
  EXPECT_NEAR(within / double(kRuns), 0.9, 0.1);
}

TEST(CameraCalibration, ABentBoardIsSeenToBeBent) {
  Random random(5);
  const Eigen::Vector2d warp(4e-4, -2e-4);
  const std::vector<CalibrationView> views = viewsOf(random, cameraWith("", {}), 20, 0.1, warp);
  CameraOptions options;
  options.model = "plumb_bob";
  const CameraCalibration bent = calibrateCamera(views, 1280, 1024, options);
  EXPECT_LT((bent.warp - warp).norm(), 5e-5);
  options.free_warp = false;
  const CameraCalibration flat = calibrateCamera(views, 1280, 1024, options);
  EXPECT_LT(bent.left_out_rms, flat.left_out_rms);
  EXPECT_LT(std::abs(bent.camera.fx - 1402), std::abs(flat.camera.fx - 1402));
}

TEST(CameraCalibration, OneWrongPointMovesNothing) {
  Random random(6);
  std::vector<CalibrationView> views = viewsOf(random, cameraWith("", {}), 12, 0.1);
  CameraOptions options;
  options.model = "plumb_bob";
  const double before = calibrateCamera(views, 1280, 1024, options).camera.fx;
  views[3].points[10].uv_raw += Eigen::Vector2d(30, -20);
  EXPECT_NEAR(calibrateCamera(views, 1280, 1024, options).camera.fx, before, 1);
}

TEST(CameraCalibration, SaysWhatIsWrongWithTheViews) {
  Random random(7);
  std::vector<CalibrationView> views = viewsOf(random, cameraWith("", {}), 6, 0.1);
  const auto refused = [&](const CameraOptions& options) {
    return refusal([&] { calibrateCamera(views, 1280, 1024, options); });
  };
  CameraOptions unknown;
  unknown.model = "fish";
  EXPECT_THAT(refused(unknown), HasSubstr("fish"));
  views[1].points.resize(3);
  EXPECT_THAT(refused({}), HasSubstr("view 1: 3 points"));
  views.resize(1);
  EXPECT_THAT(refused({}), HasSubstr("at least 3 views"));
}

}  // namespace
}  // namespace monocular_eye_hand
