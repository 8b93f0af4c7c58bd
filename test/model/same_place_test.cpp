#include "monocular_eye_hand/model/same_place.h"

#include <gtest/gtest.h>

#include <cmath>

namespace monocular_eye_hand {
namespace {

const Eigen::Vector3d kCentre(0.05, 0.05, 0.05);  // a cube whose frame lies in a corner

Rigid3 turned(double angle) { return {expSO3({0, 0, angle}), {0.3, -0.2, 0.7}}; }

Rigid3 movedPose(const Rigid3& pose, const Eigen::Vector3d& by) {
  return {pose.rotation, pose.translation + by};
}

TEST(SamePlace, CentresAreComparedNotFrames) {
  const Rigid3 a = turned(0.4);
  Rigid3 half_turn = turned(0.4 + M_PI);
  half_turn.translation += a * kCentre - half_turn * kCentre;
  EXPECT_GT((half_turn.translation - a.translation).norm(), 0.1);
  EXPECT_LT(centreOffset(kCentre, a, half_turn).norm(), 1e-12);
  EXPECT_TRUE(samePlace(kCentre, a, half_turn, 1e-9));
  EXPECT_FALSE(samePlace(kCentre, a, movedPose(half_turn, {0, 0.02, 0}), 0.01));
}

TEST(SamePlace, TheOffsetGoesFromTheFirstToTheSecond) {
  const Eigen::Vector3d by(0.01, -0.02, 0.03);
  EXPECT_LT((centreOffset(kCentre, turned(1), movedPose(turned(1), by)) - by).norm(), 1e-12);
}

TEST(SamePlace, WithinReachCountsUpToItsEnd) {
  const Rigid3 here, there = movedPose(here, {0.25, 0, 0});
  EXPECT_TRUE(samePlace(Eigen::Vector3d::Zero(), here, there, 0.25));
  EXPECT_FALSE(samePlace(Eigen::Vector3d::Zero(), here, there, 0.249));
  EXPECT_FALSE(samePlace(Eigen::Vector3d::Zero(), here, there, std::nan("")));
}

TEST(SamePlace, OfTwoModelsTheCentresCount) {
  EXPECT_TRUE(samePlace(Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0.25, 1), 0.25));
  EXPECT_FALSE(samePlace(Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0.25, 1), 0.249));
}

TEST(SamePlace, AlongEachAxisOfTheFirst) {
  const Eigen::Vector3d reach(0.1, 0.02, 0.01);
  const Rigid3 a = turned(M_PI / 2);  // its x is the frame's y
  EXPECT_TRUE(samePlace(kCentre, a, movedPose(a, {0, 0.09, 0}), reach));
  EXPECT_TRUE(samePlace(kCentre, a, movedPose(a, {0.015, -0.09, 0.009}), reach));
  EXPECT_FALSE(samePlace(kCentre, a, movedPose(a, {0.03, 0, 0}), reach));
  EXPECT_FALSE(samePlace(kCentre, a, movedPose(a, {0, 0, -0.02}), reach));
  EXPECT_FALSE(samePlace(kCentre, a, movedPose(a, {0, 0.11, 0}), reach));
}

}  // namespace
}  // namespace monocular_eye_hand
