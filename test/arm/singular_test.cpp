// What the inverse returns reaches the pose to 1e-12, whatever the arm: anywhere, near and on the
// singularities.
#include <gtest/gtest.h>

#include <cmath>

#include "random_arm.h"

namespace monocular_eye_hand {
namespace {

struct Residual {
  double metres = 0, radians = 0;
  int poses = 0, missed = 0;  ///< missed: nothing found although the joints are within limits
  int solutions = 0;
};

void measure(const Puma560& arm, const JointVector& q, const JointVector& current, Residual* worst) {
  static ArmSolutions found;
  const Rigid3 pose = arm.baseFromTool0(q);
  arm.inverse(pose, current, &found);
  ++worst->poses;
  worst->missed += found.empty();
  worst->solutions += found.size();
  for (const ArmSolution& s : found) {
    const Rigid3 reached = arm.baseFromTool0(s.joints);
    worst->metres = std::max(worst->metres, (reached.translation - pose.translation).norm());
    worst->radians = std::max(worst->radians, rotationError(reached.rotation, pose.rotation));
    EXPECT_TRUE(arm.withinLimits(s.joints));
  }
}

void expectExact(const Residual& r) {
  EXPECT_LE(r.metres, 1e-12);
  EXPECT_LE(r.radians, 1e-12);
  EXPECT_EQ(r.missed, 0) << "of " << r.poses;
}

TEST(Puma560Inverse, ExactAnywhere) {
  const Puma560 arm;
  Random random(5);
  Residual worst;
  for (int k = 0; k < 50000; ++k)
    measure(arm, randomJoints(random, arm.options()), JointVector::Zero(), &worst);
  expectExact(worst);
  EXPECT_GT(worst.solutions, 3 * worst.poses);
}

TEST(Puma560Inverse, ExactNearEverySingularity) {
  const Puma560 arm;
  for (int which = 1; which < 8; ++which) {
    SCOPED_TRACE(which);
    Random random(6);
    Residual worst;
    for (int k = 0; k < 10000; ++k) {
      const JointVector q = nearSingular(random, arm.options(), which);
      if (!arm.withinLimits(q, 0)) continue;
      measure(arm, q, randomJoints(random, arm.options()), &worst);
    }
    EXPECT_GT(worst.poses, 2000);
    expectExact(worst);
  }
}

TEST(Puma560Inverse, ExactWithOtherLengths) {
  Puma560Options options;  // as calibrations of real arms differ; and without the shoulder's offset
  options.a3 = -0.0203;
  options.d3 = 0.149;
  options.d4 = 0.4331;
  options.d6 = 0.0558;

  for (double d3 : {0.149, -0.149, 0.0}) {
    options.d3 = d3;
    const Puma560 arm(options);
    for (int which = 0; which < 8; ++which) {
      Random random(7);
      Residual worst;
      for (int k = 0; k < 2000; ++k) {
        const JointVector q = nearSingular(random, options, which);
        if (arm.withinLimits(q, 0)) measure(arm, q, randomJoints(random, options), &worst);
      }
      if (d3 == 0 && which & 1)
        worst.missed = 0;  // the wrist's limits may not suit the joint 1 that was kept
      expectExact(worst);
    }
  }
}

TEST(Puma560Inverse, StraightWristKeepsJoint4) {
  const Puma560 arm;
  Random random(8);
  ArmSolutions found;

  for (int k = 0; k < 500; ++k) {
    JointVector q = randomJoints(random, arm.options());
    q[4] = 0;
    JointVector current = randomJoints(random, arm.options());
    arm.inverse(arm.baseFromTool0(q), current, &found);
    ASSERT_FALSE(found.empty());
    int kept = 0;
    for (const ArmSolution& s : found) {
      if (std::abs(s.joints[4]) > 1e-6) continue;  // another shoulder or elbow, with a bent wrist
      EXPECT_EQ(s.joints[4], 0);
      EXPECT_EQ(s.configuration.wrist, Wrist::kPositive);
      kept += s.joints[3] == current[3];
    }
    EXPECT_GE(kept, 1);  // a turn of joint 6 is always left
  }
}

TEST(Puma560Inverse, StraightWristMovesJoint4AsLittleAsJoint6Asks) {
  Puma560Options options;
  options.joints[5].lower = -0.5;
  options.joints[5].upper = 0.5;
  const Puma560 arm(options);
  JointVector q = JointVector::Zero(), current = JointVector::Zero();
  q[1] = 0.5;
  q[3] = 1.0;
  q[5] = 0.3;
  ArmSolutions found;
  arm.inverse(arm.baseFromTool0(q), current, &found);
  int straight = 0;
  for (const ArmSolution& s : found) {
    if (s.joints[4] != 0) continue;
    ++straight;
    EXPECT_NEAR(s.joints[3], 0.8, 1e-12);
    EXPECT_NEAR(s.joints[5], 0.5, 1e-12);
  }

  EXPECT_EQ(straight, 1);
}

TEST(Puma560Inverse, WristTurnedBackOnItself) {
  Puma560Options options;  // q5 = 180 degrees, as no real wrist can
  options.joints[4].lower = 0;
  options.joints[4].upper = 6;
  const Puma560 arm(options);
  Random random(9);
  Residual worst;
  for (int k = 0; k < 500; ++k) {
    JointVector q = randomJoints(random, options), current = randomJoints(random, options);
    q[4] = M_PI + (k % 2 ? tiny(random) : 0);
    measure(arm, q, current, &worst);
  }
  expectExact(worst);
}

TEST(Puma560Inverse, ConfigurationsThatMeetAreOne) {
  const Puma560 arm;
  ArmSolutions found;

  // Beyond the stretched arm by less than the tolerance: one elbow.
  JointVector q = JointVector::Zero();
  q[1] = 0.3;
  q[2] = stretchedElbow(arm.options());
  q[4] = 0.5;
  q[3] = 0.2;
  const Rigid3 stretched = arm.baseFromTool0(q);
  const Rigid3 wrist = arm.baseFromLinks(q)[4], shoulder = arm.baseFromLinks(q)[0];
  Rigid3 beyond = stretched;
  const Eigen::Vector3d offset = arm.options().d3 * Eigen::Vector3d(0, -1, 0);
  const Eigen::Vector3d outwards = (wrist.translation - shoulder.translation - offset).normalized();
  beyond.translation += 3e-13 * outwards;
  arm.inverse(beyond, q, &found);
  ASSERT_FALSE(found.empty());
  for (const ArmSolution& s : found) {
    EXPECT_EQ(s.configuration.elbow, Elbow::kUp);
    EXPECT_LE((arm.baseFromTool0(s.joints).translation - beyond.translation).norm(), 1e-12);
  }
  beyond.translation = stretched.translation + 1e-9 * outwards;
  arm.inverse(beyond, q, &found);
  EXPECT_TRUE(found.empty());
}

TEST(Puma560Inverse, WristOnAxis1KeepsJoint1) {
  Puma560Options options;
  options.d3 = 0;
  const Puma560 arm(options);
  JointVector q = JointVector::Zero(), current = JointVector::Zero();
  q[2] = -0.9;
  q[1] = uprightShoulder(options, q[2]);
  q[4] = 0.4;
  current[0] = 0.7;
  ArmSolutions found;
  arm.inverse(arm.baseFromTool0(q), current, &found);
  int kept = 0;
  for (const ArmSolution& s : found) kept += s.joints[0] == current[0];
  EXPECT_GE(kept, 1);
}

}  // namespace
}  // namespace monocular_eye_hand
