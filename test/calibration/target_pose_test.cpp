#include "calibration/target_pose.h"

#include <gtest/gtest.h>

#include "session.h"
#include "support/pose_matchers.h"

namespace monocular_eye_hand {
namespace {

CalibrationView seenFrom(const Rigid3& camera_from_target, const Camera& camera,
                         const std::vector<Eigen::Vector3d>& points) {
  CalibrationView view;
  for (const Eigen::Vector3d& p : points)
    view.points.push_back({p, camera.distort(camera.project(camera_from_target * p)), 0.1});
  return view;
}

TEST(TargetPose, FindsABoardThroughAnyLens) {
  Random random(1);
  for (const Camera& camera : {unevenCamera(), withWebcamLens(unevenCamera())})
    for (int run = 0; run < 100; ++run) {
      Rigid3 pose = cameraBeforeBoard(random, 0.9);
      pose.translation.z() += 0.2;
      const auto found = targetPose(seenFrom(pose, camera, boardCorners()), camera);
      ASSERT_TRUE(found.has_value()) << run;
      EXPECT_THAT(*found, PoseNear(pose, 1e-3, 1e-3)) << run;
    }
}

TEST(TargetPose, FindsTargetsThatAreNotFlat) {
  Random random(2);
  for (int run = 0; run < 100; ++run) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 6; ++i) points.push_back(0.1 * randomDirection(random));
    const Rigid3 pose{randomRotation(random), {0.05, -0.02, 0.8}};
    const auto found = targetPose(seenFrom(pose, unevenCamera(), points), unevenCamera());
    ASSERT_TRUE(found.has_value());
    EXPECT_THAT(*found, PoseNear(pose, 1e-3, 1e-3));
  }
}

TEST(TargetPose, ThereIsNoneOfTooFewPointsOrOfALine) {
  const Rigid3 pose{Eigen::Matrix3d::Identity(), {0, 0, 0.5}};
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i < 8; ++i) line.emplace_back(0.02 * i, 0.01 * i, 0);
  EXPECT_FALSE(targetPose(seenFrom(pose, unevenCamera(), line), unevenCamera()).has_value());
  EXPECT_FALSE(
      targetPose(seenFrom(pose, unevenCamera(), {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}), unevenCamera())
          .has_value());
}

}  // namespace
}  // namespace monocular_eye_hand
