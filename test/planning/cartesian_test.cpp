#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "scene.h"

namespace monocular_eye_hand {
namespace {

TEST(CartesianPath, StaysOnTheLineInItsConfiguration) {
  const ToolArm arm = toolArm();
  const JointVector start = lookingJoints();
  const Rigid3 from = arm.baseFromTcp(start), to = down(0.55, 0.08, 0.38, 0.4);
  const CartesianOptions options;
  const CartesianPath path = cartesianPath(arm, start, to, options);
  ASSERT_TRUE(path.found()) << path.reason;
  EXPECT_LT((arm.baseFromTcp(path.points.back()).translation - to.translation).norm(), 1e-9);
  EXPECT_LT(angleBetween(arm.baseFromTcp(path.points.back()).rotation, to.rotation), 1e-9);

  const Eigen::Vector3d line = (to.translation - from.translation).normalized();
  for (size_t i = 0; i + 1 < path.points.size(); ++i) {
    EXPECT_EQ(arm.arm.configuration(path.points[i]), arm.arm.configuration(start));
    EXPECT_TRUE(arm.arm.withinLimits(path.points[i]));
    for (int k = 0; k < 10; ++k) {
      const JointVector q = path.points[i] + 0.1 * k * (path.points[i + 1] - path.points[i]);
      const Eigen::Vector3d off = arm.baseFromTcp(q).translation - from.translation;
      EXPECT_LT((off - line * line.dot(off)).norm(), 1.1 * options.deviation);
    }
  }
}

TEST(CartesianPath, RefusalsSayWhyAndWhere) {
  const ToolArm arm = toolArm();
  const CartesianPath far = cartesianPath(arm, lookingJoints(), down(1.2, 0, 0.6));
  EXPECT_FALSE(far.found());
  EXPECT_NE(far.reason.find("mm"), std::string::npos);
  EXPECT_GE(far.points.size(), 1u);

  // With the hand turned through level ahead of the forearm the wrist becomes straight.
  JointVector straight = lookingJoints();
  straight[4] = 0.005;
  const CartesianPath singular = cartesianPath(arm, straight, down(0.5, 0, 0.5));
  EXPECT_EQ(singular.outcome, CartesianOutcome::kSingular);
  EXPECT_NE(singular.reason.find("wrist"), std::string::npos);

  CartesianOptions strict;
  strict.joint_jump = 1e-3;
  strict.max_step = 1;
  EXPECT_TRUE(cartesianPath(arm, lookingJoints(), down(0.45, 0, 0.6), strict).found()) << "steps get shorter";
  EXPECT_EQ(cartesianPath(arm, lookingJoints(), down(0.45, 0, 0.62)).points.size(), 1u) << "it is there";
}

TEST(CartesianPath, RefusesBadInput) {
  const ToolArm arm = toolArm();
  EXPECT_THROW(cartesianPath(arm, JointVector::Constant(NAN), down(0.5, 0, 0.5)), BadInput);
  EXPECT_THROW(cartesianPath(arm, JointVector::Constant(3), down(0.5, 0, 0.5)), BadInput);
  EXPECT_THROW(cartesianPath(arm, lookingJoints(), at(NAN, 0, 0)), BadInput);
}

TEST(ToolArm, VelocityIsTheDerivative) {
  const ToolArm arm = toolArm();
  JointVector q = lookingJoints(), speeds;
  speeds << 0.3, -0.2, 0.5, 0.1, -0.4, 0.6;
  const double h = 1e-6;
  const Eigen::Vector3d difference =
      (arm.baseFromTcp(q + h * speeds).translation - arm.baseFromTcp(q - h * speeds).translation) / (2 * h);
  EXPECT_LT((arm.tcpVelocity(q, speeds) - difference).norm(), 1e-8);
}

}  // namespace
}  // namespace monocular_eye_hand
