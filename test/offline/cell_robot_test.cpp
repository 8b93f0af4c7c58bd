#include "offline/cell_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monocular_eye_hand/execution/robot_motion.h"
#include "small_cell.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

/// Joint 1 turns by this in a second, at rest at both ends.
Trajectory turn(const JointVector& from, double angle) {
  Trajectory trajectory;
  trajectory.points.resize(3);
  for (int k = 0; k < 3; ++k) {
    TrajectoryState& state = trajectory.points[size_t(k)];
    state.time_s = 0.5 * k;
    state.position = from;
    state.position[0] += angle * 0.5 * k;
  }
  trajectory.points[1].velocity[0] = 2 * angle;
  trajectory.points[0].acceleration[0] = 4 * angle;
  trajectory.points[1].acceleration[0] = -4 * angle;
  return trajectory;
}

class CellRobotTest : public testing::Test {
 protected:
  MotionMonitor monitor() {
    MotionMonitor monitor;
    monitor.cancelled = [this] { return robot.clock() > cancel_at; };
    return monitor;
  }
  JointVector joints() const { return robot.state().joints->joints; }

  WorkCell cell = cellWithABridge();
  CellRobot robot{&cell};
  RobotMotion motion{&robot, {}, 0.1};
  double cancel_at = 1e9;  // [s]
};

TEST_F(CellRobotTest, TellsItsStateBeforeAnythingMoved) {
  const RobotState state = robot.state();
  ASSERT_TRUE(state.joints && state.gripper);
  EXPECT_EQ(state.joints->joints, cell.joints());
  EXPECT_EQ(state.joints->speed, 0);
  EXPECT_EQ(state.gripper->width, cell.gripperWidth());
  EXPECT_TRUE(robot.connected());
}

TEST_F(CellRobotTest, TimePassesOnlyWhileSomebodyWaits) {
  const double before = robot.clock();
  robot.send(turn(joints(), 0.2));
  robot.state();
  EXPECT_EQ(robot.clock(), before);
  robot.wait(0.004);  // nothing is told yet
  EXPECT_NEAR(robot.clock(), before + 0.004, 1e-9);
  EXPECT_EQ(robot.state().joints->stamp, before);
  EXPECT_NEAR(robot.state().joint_silence, 0.004, 1e-9);

  robot.wait(1);  // until the next state, and no longer
  EXPECT_NEAR(robot.clock(), before + 0.01, 1e-9);
  EXPECT_NEAR(robot.state().joints->stamp, before + 0.01, 1e-9);
  EXPECT_EQ(robot.state().joint_silence, 0);
  EXPECT_EQ(robot.takeJoints().size(), 2u);
  EXPECT_TRUE(robot.takeJoints().empty());
}

TEST_F(CellRobotTest, FollowsATrajectoryToItsEnd) {
  const JointVector from = joints();
  const MotionResult moved = motion.follow(turn(from, 0.2), monitor());
  EXPECT_TRUE(moved.done()) << moved.reason;
  EXPECT_NEAR(joints()[0], from[0] + 0.2, 1e-6);
  EXPECT_NEAR(motion.motionTime(), 1, 0.05);
}

TEST_F(CellRobotTest, StopsOnRequestAndStands) {
  const JointVector from = joints();
  cancel_at = robot.clock() + 0.5;
  const MotionResult moved = motion.follow(turn(from, 0.2), monitor());
  EXPECT_EQ(moved.outcome, ActionOutcome::kCancelled);
  EXPECT_LT(robot.state().joints->speed, 0.01);
  EXPECT_GT(joints()[0], from[0]);
  EXPECT_LT(joints()[0], from[0] + 0.2);
}

TEST_F(CellRobotTest, TheFingersMove) {
  EXPECT_TRUE(motion.openGripper(0.08, monitor()).done());
  EXPECT_NEAR(robot.state().gripper->width, 0.08, 1e-3);
  EXPECT_TRUE(motion.closeGripper(0.02, monitor()).done());
  EXPECT_NEAR(robot.state().gripper->width, 0.02, 1e-3);
  EXPECT_FALSE(robot.state().gripper->holds(0.002));
}

TEST_F(CellRobotTest, WhatCannotBeIsNotObeyedAndEndsAsAFault) {
  const MotionResult opened = motion.openGripper(0.5, monitor());
  EXPECT_EQ(opened.outcome, ActionOutcome::kFault);
  EXPECT_THAT(opened.reason, HasSubstr("in time"));

  const MotionResult far = motion.follow(turn(joints(), 50), monitor());  // faster than it can
  EXPECT_EQ(far.outcome, ActionOutcome::kFault);
}

TEST_F(CellRobotTest, RestsAtLeastUntilSomethingIsTold) {
  const double before = robot.clock();
  robot.rest(0);
  EXPECT_NEAR(robot.clock(), before + 0.01, 1e-9);
  robot.rest(0.15);
  EXPECT_NEAR(robot.clock(), before + 0.16, 1e-9);
}

}  // namespace
}  // namespace monocular_eye_hand
