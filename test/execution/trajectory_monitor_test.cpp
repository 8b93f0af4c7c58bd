#include <gtest/gtest.h>

#include <cmath>

#include "monocular_eye_hand/execution/trajectory_monitor.h"
#include "turn.h"

namespace monocular_eye_hand {
namespace {

using State = TrajectoryMonitor::State;

State drive(TrajectoryMonitor* monitor, double late, double until, double offset = 0) {
  State state = State::kMoving;
  for (double t = 0; t < until && state == State::kMoving; t += 0.01) {
    const TrajectoryState at = turn().sample(std::max(0.0, t - late));
    JointVector joints = at.position;
    joints[2] += offset;
    state = monitor->update(100 + t, joints, at.velocity.cwiseAbs().maxCoeff());
  }
  return state;
}

TEST(TrajectoryMonitor, ArrivesInTime) {
  TrajectoryMonitor monitor(turn(), 100, FollowOptions());
  EXPECT_EQ(monitor.progress(), 0);
  EXPECT_EQ(drive(&monitor, 0, 1), State::kMoving);
  EXPECT_NEAR(monitor.progress(), 0.5, 0.02);
  EXPECT_EQ(monitor.update(102.01, turn().points.back().position, 0), State::kArrived);
  EXPECT_EQ(monitor.progress(), 1);
}

TEST(TrajectoryMonitor, AnArmThatStartsLateArrivesLate) {
  TrajectoryMonitor monitor(turn(), 100, FollowOptions());
  EXPECT_EQ(drive(&monitor, 1.5, 3.3), State::kMoving);
  TrajectoryMonitor again(turn(), 100, FollowOptions());
  EXPECT_EQ(drive(&again, 1.5, 4), State::kArrived);
}

TEST(TrajectoryMonitor, AnArmThatDoesNotMoveIsTooLate) {
  TrajectoryMonitor monitor(turn(), 100, FollowOptions());
  EXPECT_EQ(drive(&monitor, 100, 5), State::kFailed);
  EXPECT_NE(monitor.reason().find("behind the plan"), std::string::npos) << monitor.reason();
}

TEST(TrajectoryMonitor, OffThePath) {
  TrajectoryMonitor monitor(turn(), 100, FollowOptions());
  EXPECT_EQ(drive(&monitor, 0, 5, 0.05), State::kFailed) << "never near enough to the goal";
  EXPECT_NE(monitor.reason().find("joint3 is 0.05 rad off"), std::string::npos) << monitor.reason();
  EXPECT_NE(monitor.reason().find("did not come to rest"), std::string::npos) << monitor.reason();
  TrajectoryMonitor far(turn(), 100, FollowOptions());
  EXPECT_EQ(drive(&far, 0, 5, 0.2), State::kFailed);
  EXPECT_NE(far.reason().find("joint3 is 0.2 rad off the planned path"), std::string::npos) << far.reason();
}

TEST(TrajectoryMonitor, OldStatesAndMovingJointsAreNoArrival) {
  TrajectoryMonitor monitor(turn(), 100, FollowOptions());
  const JointVector goal = turn().points.back().position;
  EXPECT_EQ(monitor.update(99, goal, 0), State::kMoving) << "a stamp before the command";
  EXPECT_EQ(drive(&monitor, 0, 1.99), State::kMoving);
  EXPECT_EQ(monitor.update(102.1, goal, 0.5), State::kMoving) << "it passes the goal";
  EXPECT_EQ(monitor.update(102.2, goal, 0.001), State::kArrived);
}

}  // namespace
}  // namespace monocular_eye_hand
