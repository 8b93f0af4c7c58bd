#include "calibration/hand_eye.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "monocular_eye_hand/geometry/error.h"
#include "session.h"
#include "support/pose_matchers.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

struct Errors {
  double millimetres = 0, degrees = 0;  ///< medians
};

Errors medianErrors(SessionOptions options, int runs) {
  Random random(7);
  std::vector<double> millimetres, degrees;
  for (int run = 0; run < runs; ++run) {
    const Session s = session(random, options);
    const HandEyeCalibration result = calibrateHandEye(s.views, s.camera, knowing(options));
    millimetres.push_back(millimetresBetween(result.mount_from_camera, s.mount_from_camera));
    degrees.push_back(degreesBetween(result.mount_from_camera, s.mount_from_camera));
  }
  std::nth_element(millimetres.begin(), millimetres.begin() + runs / 2, millimetres.end());
  std::nth_element(degrees.begin(), degrees.begin() + runs / 2, degrees.end());
  return {millimetres[size_t(runs) / 2], degrees[size_t(runs) / 2]};
}

TEST(HandEye, ExactPosesAndPixelsGiveTheTruthInBothMounts) {
  for (const CameraMount mount : {CameraMount::kInHand, CameraMount::kFixed}) {
    Random random(1);
    SessionOptions options;
    options.mount = mount;
    options.pixel_sigma = 1e-6;
    const Session s = session(random, options);
    const HandEyeCalibration result = calibrateHandEye(s.views, s.camera, knowing(options));
    EXPECT_THAT(result.mount_from_camera, PoseNear(s.mount_from_camera, 1e-4, 1e-5));
    EXPECT_THAT(result.target, PoseNear(s.target, 1e-4, 1e-5));
    ASSERT_EQ(result.residuals.size(), s.views.size());
    for (const HandEyeResidual& residual : result.residuals) EXPECT_LT(residual.pixel_rms, 1e-4);
  }
}

// What the closed forms and plain reprojection reach on such sessions stands in no test: see the benchmark.
TEST(HandEye, AnArmThatRepeatsWellIsNoHindrance) {
  SessionOptions options;
  options.arm_sigma_translation = 5e-5;
  options.arm_sigma_rotation = 0.01 * M_PI / 180;
  for (const CameraMount mount : {CameraMount::kInHand, CameraMount::kFixed}) {
    options.mount = mount;
    const Errors errors = medianErrors(options, 40);
    EXPECT_LT(errors.millimetres, mount == CameraMount::kInHand ? 0.12 : 0.3);
    EXPECT_LT(errors.degrees, 0.02);
  }
}

TEST(HandEye, AnArmThatWasNeverCalibratedIsAveragedOut) {
  SessionOptions options;
  options.views = 25;
  options.arm_sigma_translation = 1e-3;
  options.arm_sigma_rotation = 0.1 * M_PI / 180;
  const Errors errors = medianErrors(options, 30);
  EXPECT_LT(errors.millimetres, 0.7);
  EXPECT_LT(errors.degrees, 0.06);
}

TEST(HandEye, TheTruthIsInTheToldEllipsoidAsOftenAsTold) {
  constexpr int kRuns = 150;
  constexpr double kNineTenths = 13.36;  // chi squared of eight degrees of freedom
  Random random(11);
  SessionOptions options;
  options.arm_sigma_translation = 1e-4;
  options.arm_sigma_rotation = 2e-4;
  HandEyeOptions unsure = knowing(options);
  unsure.focal_sigma = 0.01;
  unsure.scale_sigma = 1e-3;

  int inside = 0;
  for (int run = 0; run < kRuns; ++run) {
    Session s = session(random, options);
    const double focal = 0.01 * normal(random);
    const double scale = 1e-3 * normal(random);
    Camera told = s.camera;
    told.fx *= std::exp(-focal);
    told.fy *= std::exp(-focal);
    for (HandEyeView& view : s.views)
      for (TargetPoint& point : view.points) point.p_in_target *= std::exp(-scale);
    const HandEyeCalibration result = calibrateHandEye(s.views, told, unsure);
    Eigen::Matrix<double, 8, 1> off;
    off << difference(s.mount_from_camera, result.mount_from_camera),
        std::log(result.camera.fx / s.camera.fx), std::log(result.target_scale) - scale;
    inside += off.dot(result.covariance.llt().solve(off)) < kNineTenths;
  }
  EXPECT_NEAR(inside / double(kRuns), 0.9, 0.06);
}

TEST(HandEye, OneSwappedViewStandsOut) {
  Random random(3);
  SessionOptions options;
  options.arm_sigma_translation = 1e-4;
  options.arm_sigma_rotation = 2e-4;
  Session s = session(random, options);
  s.views[4].base_from_tool = jittered(random, s.views[4].base_from_tool, 0.01, 0.02);
  const HandEyeCalibration result = calibrateHandEye(s.views, s.camera, knowing(options));
  const auto worst = std::max_element(result.residuals.begin(), result.residuals.end(),
                                      [](const HandEyeResidual& a, const HandEyeResidual& b) {
                                        return a.arm_translation < b.arm_translation;
                                      });
  EXPECT_EQ(worst->name, "view 4");
}

TEST(HandEye, SaysWhatIsWrongWithTheViews) {
  Random random(5);
  const Session s = session(random, {});
  const auto refused = [&](const std::vector<HandEyeView>& views) {
    return refusal([&] { calibrateHandEye(views, s.camera); });
  };
  EXPECT_THAT(refused({s.views[0], s.views[1]}), HasSubstr("at least 3 views"));

  std::vector<HandEyeView> few = s.views;
  few[2].points.resize(3);
  EXPECT_THAT(refused(few), HasSubstr("view 2: its 3 points"));

  std::vector<HandEyeView> still(5, s.views[0]);
  EXPECT_THAT(refused(still), HasSubstr("one axis only"));
}

}  // namespace
}  // namespace monocular_eye_hand
