#include "monocular_eye_hand/execution/robot_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripted_robot.h"
#include "support/refusal.h"
#include "turn.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class RobotMotionTest : public testing::Test {
 protected:
  MotionMonitor monitor() {
    MotionMonitor monitor;
    monitor.cancelled = [this] { return cancel; };
    monitor.reportProgress = [this](double progress) { reported.push_back(progress); };
    return monitor;
  }
  MotionMonitor carrying() {
    MotionMonitor holding = monitor();
    holding.lost = [this](const GripperReading&) { return gone; };
    return holding;
  }
  /// From so long after now on [s].
  void after(double seconds, const std::function<void()>& change) {
    const double at = robot.wallClock() + seconds;
    robot.on_step = [this, at, change] {
      if (robot.wallClock() >= at) change();
    };
  }
  void expectStopped() {
    EXPECT_EQ(robot.sent_stops, 1);
    EXPECT_EQ(robot.commands.back(), "stop");
    EXPECT_TRUE(robot.stands()) << "it was waited for";
  }

  ScriptedRobot robot;
  RobotMotion motion{&robot, ExecutionOptions(), 0.1};
  bool cancel = false;
  std::string gone;
  std::vector<double> reported;
};

TEST_F(RobotMotionTest, FollowsATrajectory) {
  const MotionResult result = motion.follow(turn(), monitor());
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_NEAR(robot.joints[0], 1, 1e-9);
  EXPECT_THAT(robot.commands, ElementsAre("arm"));
  EXPECT_NEAR(motion.motionTime(), 2, 0.1);
  EXPECT_EQ(reported.back(), 1);
  EXPECT_NEAR(double(reported.size()), 20, 3) << "one in each period";
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  motion.resetMotionTime();
  EXPECT_EQ(motion.motionTime(), 0);
}

TEST_F(RobotMotionTest, NothingToFollow) {
  EXPECT_TRUE(motion.follow(Trajectory(), monitor()).done());
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(RobotMotionTest, StatesOfBeforeAreNoPartOfTheMotion) {
  robot.joints[0] = 1;
  for (int i = 0; i < 10; ++i) robot.wait(0.01);
  robot.joints[0] = 0;
  robot.wait(0.01);
  EXPECT_TRUE(motion.follow(turn(), monitor()).done());
}

TEST_F(RobotMotionTest, CancelledArmsAreStoppedAndWaitedFor) {
  after(0.5, [this] { cancel = true; });
  const MotionResult result = motion.follow(turn(), monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kCancelled);
  EXPECT_EQ(result.reason, "cancelled");
  EXPECT_LT(robot.joints[0], 0.3);
  expectStopped();
}

TEST_F(RobotMotionTest, AnArmOffItsPathIsStopped) {
  after(0.5, [this] { robot.offset = 0.3; });
  const MotionResult result = motion.follow(turn(), monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("joint3 is 0.3 rad off the planned path"));
  expectStopped();
}

TEST_F(RobotMotionTest, AnArmThatDoesNotMoveIsStopped) {
  robot.follows = false;
  const MotionResult result = motion.follow(turn(), monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("behind the plan"));
  expectStopped();
}

TEST_F(RobotMotionTest, SilentJointsAreAFault) {
  after(0.5, [this] { robot.tells_joints = false; });
  const MotionResult result = motion.follow(turn(), monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("joint_states is silent for 2"));
  EXPECT_EQ(robot.sent_stops, 1);
}

TEST_F(RobotMotionTest, CancelledWithSilentJoints) {
  after(0.5, [this] {
    robot.tells_joints = false;
    cancel = true;
  });
  const MotionResult result = motion.follow(turn(), monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault) << "nobody knows whether it stands";
  EXPECT_THAT(result.reason, HasSubstr("cancelled; joint_states is silent for"));
  EXPECT_THAT(result.reason, HasSubstr("whether the arm stopped is not known"));
  EXPECT_EQ(robot.sent_stops, 1);
}

TEST_F(RobotMotionTest, AnArmThatDoesNotStop) {
  robot.stops = false;
  after(0.5, [this] { cancel = true; });
  const double begin = robot.clock();
  const MotionResult result = motion.follow(turn(), monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_EQ(result.reason, "cancelled; the arm does not stop");
  EXPECT_NEAR(robot.clock() - begin, 0.5 + ExecutionOptions().stop_timeout, 0.1);
}

TEST_F(RobotMotionTest, ACancelWhileTheClockStandsDoesNotWaitForEver) {
  after(0.5, [this] {
    robot.clock_runs = false;
    cancel = true;
  });
  const double begin = robot.wallClock();
  const MotionResult result = motion.follow(turn(), monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_EQ(robot.sent_stops, 1);
  EXPECT_NEAR(robot.wallClock() - begin, 0.5 + 2 * ExecutionOptions().stop_timeout, 0.1);
}

TEST_F(RobotMotionTest, AClockThatStandsIsNoSilence) {
  const double stands_from = robot.wallClock() + 0.5;
  robot.on_step = [this, stands_from] {
    const double at = robot.wallClock() - stands_from;
    robot.clock_runs = at < 0 || at > 60;
  };
  EXPECT_TRUE(motion.follow(turn(), monitor()).done());
}

TEST_F(RobotMotionTest, CutLinesAreACancel) {
  after(0.5, [this] { robot.is_connected = false; });
  const MotionResult result = motion.follow(turn(), monitor());
  EXPECT_NE(result.outcome, ActionOutcome::kDone);
  EXPECT_EQ(robot.sent_stops, 1);
}

TEST_F(RobotMotionTest, ALostPartStopsTheArm) {
  after(0.5, [this] { gone = "it fell"; });
  const MotionResult result = motion.follow(turn(), carrying());
  EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost);
  EXPECT_EQ(result.reason, "it fell");
  expectStopped();
}

TEST_F(RobotMotionTest, ASilentGripperMattersWhileItCarries) {
  robot.tells_gripper = false;
  EXPECT_TRUE(motion.follow(turn(), monitor()).done());
  robot.joints.setZero();
  robot.wait(0.01);
  const MotionResult result = motion.follow(turn(), carrying());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("gripper/state is silent for"));
  expectStopped();
}

TEST_F(RobotMotionTest, OpensAndCloses) {
  EXPECT_TRUE(motion.openGripper(0.08, monitor()).done());
  EXPECT_NEAR(robot.width, 0.08, 1e-9);
  EXPECT_TRUE(motion.closeGripper(0.02, monitor()).done());
  EXPECT_NEAR(robot.width, 0.02, 1e-9);
  EXPECT_THAT(robot.sent_widths, ElementsAre(0.08, 0.02));
  EXPECT_THAT(reported, ElementsAre(0, 1, 0, 1));
  EXPECT_GT(motion.motionTime(), 0.8);
}

TEST_F(RobotMotionTest, ClosesOnAPart) {
  robot.part_width = 0.04;
  EXPECT_TRUE(motion.closeGripper(0.03, monitor()).done());
  EXPECT_NEAR(motion.gripper().width, 0.04, 1e-9);
  EXPECT_TRUE(motion.gripper().stalled);
}

TEST_F(RobotMotionTest, BlockedFingersDoNotOpen) {
  robot.widest_opening = 0.06;
  const MotionResult result = motion.openGripper(0.08, monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason,
              HasSubstr("something keeps the fingers from opening: they are stalled at 60.0 mm"));
}

TEST_F(RobotMotionTest, FingersThatDoNotArriveInTime) {
  robot.wait(0.01);
  robot.on_step = [this] { robot.width = 0.05 + 1e-4 * std::sin(100 * robot.wallClock()); };
  const MotionResult result = motion.closeGripper(0.02, monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("the gripper did not go to 20.0 mm in time: it stands at "));
}

TEST_F(RobotMotionTest, ACancelledGripperMotionIsFinishedFirst) {
  cancel = true;
  const MotionResult result = motion.openGripper(0.08, monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kCancelled);
  EXPECT_NEAR(robot.width, 0.08, 1e-9);
}

TEST_F(RobotMotionTest, FingersWhileTheClockStands) {
  robot.clock_runs = false;
  cancel = true;
  const MotionResult result = motion.openGripper(0.08, monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_EQ(result.reason, "cancelled; the clock stands: whether the fingers moved is not known");
}

TEST_F(RobotMotionTest, SilentFingers) {
  after(0.1, [this] { robot.tells_gripper = false; });
  const MotionResult result = motion.openGripper(0.08, monitor());
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("gripper/state is silent for 2"));
}

TEST_F(RobotMotionTest, WhoNeverToldAnythingIsNamed) {
  robot.tells_joints = robot.tells_gripper = false;
  robot.forgetAll();
  EXPECT_EQ(motion.jointStamp(), 0);
  EXPECT_EQ(refusal([this] { motion.joints(); }), "no joint_states yet: does the driver of the arm run?");
  EXPECT_EQ(refusal([this] { motion.gripper(); }), "no gripper/state yet: does the driver of the arm run?");
}

TEST_F(RobotMotionTest, TheFirstStateIsWaitedFor) {
  robot.tells_joints = false;
  robot.forgetAll();
  after(1, [this] { robot.tells_joints = true; });
  EXPECT_EQ(motion.joints(), robot.joints);
}

}  // namespace
}  // namespace monocular_eye_hand
