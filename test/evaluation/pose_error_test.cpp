#include "evaluation/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace monocular_eye_hand {
namespace {

const std::vector<Eigen::Vector3d> kCorners{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
const std::vector<Rigid3> kNone{Rigid3{}};

Rigid3 at(double x, double y, double z) { return {Eigen::Matrix3d::Identity(), {x, y, z}}; }
Rigid3 turnedAboutZ(double angle, const Eigen::Vector3d& t = Eigen::Vector3d::Zero()) {
  return {expSO3(Eigen::Vector3d(0, 0, angle)), t};
}

Eigen::Matrix3d intrinsics() {
  Eigen::Matrix3d k;
  k << 1000, 0, 320, 0, 1000, 240, 0, 0, 1;
  return k;
}

TEST(PoseError, AShiftMovesEveryPointByItsLength) {
  EXPECT_NEAR(mssd(at(0.003, 0.004, 1), at(0, 0, 1), kCorners, kNone), 0.005, 1e-12);
}

TEST(PoseError, AShiftInTheImageCountsMostForTheNearestPoint) {
  // 2 mm sideways; the points at 1 m move by 1000 * 0.002 / 1, the one at 1.1 m by less.
  EXPECT_NEAR(mspd(at(0.002, 0, 1), at(0, 0, 1), intrinsics(), kCorners, kNone), 2.0, 1e-9);
  // Depth 1 -> 1.25: the corner (0.1, 0, 0) goes from 100 px to 80 px off the centre.
  EXPECT_NEAR(mspd(at(0, 0, 1.25), at(0, 0, 1), intrinsics(), kCorners, kNone), 20.0, 1e-9);
}

TEST(PoseError, ATurnMovesTheFarthestPoint) {
  EXPECT_NEAR(mssd(turnedAboutZ(M_PI / 3, {0, 0, 1}), at(0, 0, 1), kCorners, kNone), 0.1, 1e-12);
}

TEST(PoseError, SymmetriesMakePosesEqual) {
  BopSymmetries half_turn;
  half_turn.discrete.push_back(turnedAboutZ(M_PI));
  const auto symmetries = discretized(half_turn);
  ASSERT_EQ(symmetries.size(), 2u);
  const Rigid3 truth = at(0.1, 0, 1), estimate = truth * turnedAboutZ(M_PI);
  EXPECT_NEAR(mssd(estimate, truth, kCorners, symmetries), 0, 1e-12);
  EXPECT_NEAR(mspd(estimate, truth, intrinsics(), kCorners, symmetries), 0, 1e-9);
  EXPECT_NEAR(mssd(estimate, truth, kCorners, kNone), 0.2, 1e-12);
}

TEST(PoseError, AFreeAxisIsTakenInEqualStepsAboutItsOwnLine) {
  BopSymmetries symmetries;
  symmetries.continuous.push_back({{0.05, 0, 0}, {0, 0, 1}});
  symmetries.discrete.push_back({Eigen::Vector3d(1, -1, -1).asDiagonal(), Eigen::Vector3d::Zero()});
  const auto set = discretized(symmetries, 0.05);
  ASSERT_EQ(set.size(), 2u * 63u);  // ceil(pi / 0.05) = 63 turns, with and without the flip
  for (const Rigid3& s : set) {
    const Eigen::Vector3d on_axis(0.05, 0, 0);
    EXPECT_NEAR((s * on_axis - on_axis).norm(), 0, 1e-12);
  }
  EXPECT_NEAR(angleBetween(set[0].rotation, set[1].rotation), 2 * M_PI / 63, 1e-12);
  EXPECT_EQ(discretized(symmetries).size(), 2u * 315u);

  // Half a step off: the error left is half a step's arc of the farthest point.
  const Rigid3 truth = at(0, 0, 1);
  const double half_step = M_PI / 63;
  const Eigen::Matrix3d turn = expSO3(Eigen::Vector3d(0, 0, half_step));
  const Eigen::Vector3d axis(0.05, 0, 0);
  const Rigid3 estimate = truth * Rigid3{turn, axis - turn * axis};
  const double radius = std::hypot(0.05, 0.1);
  EXPECT_NEAR(mssd(estimate, truth, kCorners, set), 2 * radius * std::sin(half_step / 2), 1e-12);
}

TEST(PoseError, APoseThatIsNotFiniteIsInfinitelyWrong) {
  const Rigid3 broken = at(std::nan(""), 0, 1);
  EXPECT_TRUE(std::isinf(mssd(broken, at(0, 0, 1), kCorners, kNone)));
  EXPECT_TRUE(std::isinf(mspd(broken, at(0, 0, 1), intrinsics(), kCorners, kNone)));
  // A corner in the camera's plane has no projection.
  EXPECT_TRUE(std::isinf(mspd(at(0, 0, 0), at(0, 0, 1), intrinsics(), kCorners, kNone)));
}

}  // namespace
}  // namespace monocular_eye_hand
