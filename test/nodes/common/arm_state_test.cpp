#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "nodes/common/arm_state.h"
#include "nodes/common/names.h"

namespace monocular_eye_hand {
namespace {

/// Joint k at `angle` + k, turning at k.
sensor_msgs::JointState message(double stamp, double angle, const std::vector<int>& joints,
                                bool speeds = true) {
  sensor_msgs::JointState state;
  state.header.stamp = ros::Time(stamp);
  for (const int k : joints) {
    state.name.push_back(names::kArmJoints[k]);
    state.position.push_back(angle + k);
    if (speeds) state.velocity.push_back(k);
  }
  return state;
}

const std::vector<int> kAll{0, 1, 2, 3, 4, 5};

TEST(ArmStates, AWholeMessageIsAState) {
  ArmStates states;
  const auto state = states.add(message(100, 0.5, {5, 4, 3, 2, 1, 0}), 1);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 100);
  EXPECT_TRUE(state->has_speeds);
  for (int k = 0; k < 6; ++k) {
    EXPECT_EQ(state->joints[k], 0.5 + k);
    EXPECT_EQ(state->speeds[k], k);
  }
}

TEST(ArmStates, WithoutSpeedsOrStamp) {
  ArmStates states;
  const auto state = states.add(message(0, 0.5, kAll, false), 77);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 77);
  EXPECT_FALSE(state->has_speeds);
}

TEST(ArmStates, TwoMessagesAreOneArm) {
  ArmStates states;
  EXPECT_FALSE(states.add(message(100, 0.5, {0, 1, 2}), 1));
  const auto state = states.add(message(100.01, 0.5, {3, 4, 5}), 1);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 100);
  EXPECT_EQ(state->joints[5], 5.5);
}

TEST(ArmStates, TheSlowestPublisherTellsHowOldItIs) {
  ArmStates states;
  states.add(message(100, 0, {0, 1, 2, 3, 4}), 1);
  ASSERT_TRUE(states.add(message(100, 0, {5}), 1));
  EXPECT_FALSE(states.add(message(101, 1, {0, 1, 2, 3, 4}), 1));  // joint6 is silent
  EXPECT_FALSE(states.add(message(102, 2, {0, 1, 2, 3, 4}), 1));
  const auto state = states.add(message(102.5, 2.5, {5}), 1);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 102);
}

TEST(ArmStates, OtherDevicesAndBrokenAnglesAreLeftOut) {
  ArmStates states;
  sensor_msgs::JointState fingers;
  fingers.name = {"finger_left_joint"};
  fingers.position = {0.01};
  EXPECT_FALSE(states.add(fingers, 1));
  sensor_msgs::JointState broken = message(100, 0.5, kAll);
  broken.position[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(states.add(broken, 1));
  EXPECT_FALSE(states.add(message(100, 0.5, {2}), 1));  // nothing of the broken one was kept
  EXPECT_TRUE(states.add(message(100.1, 0.5, kAll), 1));
}

TEST(ArmStates, TimeThatGoesBackBeginsAgain) {
  ArmStates states;
  states.add(message(100, 0, {0, 1, 2}), 1);
  ASSERT_TRUE(states.add(message(100, 0, {3, 4, 5}), 1));
  states.add(message(5, 1, {0, 1, 2}), 1);
  const auto state = states.add(message(5, 1, {3, 4, 5}), 1);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 5);
}

}  // namespace
}  // namespace monocular_eye_hand
