#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "monocular_eye_hand/arm/arm_state.h"

namespace monocular_eye_hand {
namespace {

/// Joint k at `angle` + k, turning at k.
JointSample sample(double stamp, double angle, const std::vector<int>& joints, bool speeds = true) {
  JointSample out;
  out.stamp = nanosecondsOf(stamp);
  for (const int k : joints) {
    out.names.push_back(armJointNames()[size_t(k)]);
    out.positions.push_back(angle + k);
    if (speeds) out.speeds.push_back(k);
  }
  return out;
}

const std::vector<int> kAll{0, 1, 2, 3, 4, 5};

TEST(ArmStates, AWholeMessageIsAState) {
  ArmStates states;
  const auto state = states.add(sample(100, 0.5, {5, 4, 3, 2, 1, 0}));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 100);
  EXPECT_TRUE(state->has_speeds);
  for (int k = 0; k < 6; ++k) {
    EXPECT_EQ(state->joints[k], 0.5 + k);
    EXPECT_EQ(state->speeds[k], k);
  }
}

TEST(ArmStates, WithoutSpeeds) {
  ArmStates states;
  const auto state = states.add(sample(77, 0.5, kAll, false));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 77);
  EXPECT_FALSE(state->has_speeds);
}

TEST(ArmStates, TwoMessagesAreOneArm) {
  ArmStates states;
  EXPECT_FALSE(states.add(sample(100, 0.5, {0, 1, 2})));
  const auto state = states.add(sample(100.01, 0.5, {3, 4, 5}));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 100);
  EXPECT_EQ(state->joints[5], 5.5);
}

TEST(ArmStates, TheSlowestPublisherTellsHowOldItIs) {
  ArmStates states;
  states.add(sample(100, 0, {0, 1, 2, 3, 4}));
  ASSERT_TRUE(states.add(sample(100, 0, {5})));
  EXPECT_FALSE(states.add(sample(101, 1, {0, 1, 2, 3, 4})));  // joint6 is silent
  EXPECT_FALSE(states.add(sample(102, 2, {0, 1, 2, 3, 4})));
  const auto state = states.add(sample(102.5, 2.5, {5}));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 102);
}

TEST(ArmStates, OtherDevicesAndBrokenAnglesAreLeftOut) {
  ArmStates states;
  JointSample fingers;
  fingers.names = {"finger_left_joint"};
  fingers.positions = {0.01};
  EXPECT_FALSE(states.add(fingers));
  JointSample broken = sample(100, 0.5, kAll);
  broken.positions[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(states.add(broken));
  EXPECT_FALSE(states.add(sample(100, 0.5, {2})));  // nothing of the broken one was kept
  EXPECT_TRUE(states.add(sample(100.1, 0.5, kAll)));
}

TEST(ArmStates, TimeThatGoesBackBeginsAgain) {
  ArmStates states;
  states.add(sample(100, 0, {0, 1, 2}));
  ASSERT_TRUE(states.add(sample(100, 0, {3, 4, 5})));
  states.add(sample(5, 1, {0, 1, 2}));
  const auto state = states.add(sample(5, 1, {3, 4, 5}));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 5);
}

}  // namespace
}  // namespace monocular_eye_hand
