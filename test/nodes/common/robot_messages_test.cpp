#include <gtest/gtest.h>

#include <cmath>

#include "monocular_eye_hand/arm/arm_state.h"
#include "nodes/common/robot_messages.h"

namespace monocular_eye_hand {
namespace {

TEST(RobotMessages, JointStatesAreTheArmsState) {
  sensor_msgs::JointState message;
  message.header.stamp = ros::Time(7.5);
  message.name = {"finger", "joint6", "joint5", "joint4", "joint3", "joint2", "joint1"};
  message.position = {9, 6, 5, 4, 3, 2, 1};
  const auto added = [&message] { return ArmStates().add(fromMessage(message, ros::Time(8))); };
  std::optional<ArmState> state = added();
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp, 7.5);
  EXPECT_FALSE(state->has_speeds);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(state->joints[i], i + 1);

  message.velocity = {9, -6, -5, -4, -3, -2, -1};
  state = added();
  ASSERT_TRUE(state);
  EXPECT_TRUE(state->has_speeds);
  EXPECT_EQ(state->speeds[2], -3);

  message.position[3] = NAN;
  EXPECT_FALSE(added());
  message.position[3] = 4;
  message.name[3] = "other";
  EXPECT_FALSE(added());
  message.name[3] = "joint4";
  message.position.resize(6);
  EXPECT_FALSE(added());
}

TEST(RobotMessages, WithoutStampTheyAreOfNow) {
  EXPECT_EQ(fromMessage(sensor_msgs::JointState(), ros::Time(500)).stamp, nanosecondsOf(500));
  EXPECT_EQ(fromMessage(GripperState(), ros::Time(500)).stamp, 500);
}

TEST(RobotMessages, AGripperState) {
  GripperState message;
  message.header.stamp = ros::Time(7.5);
  message.width = 0.02;
  message.stalled = true;
  const GripperReading reading = fromMessage(message, ros::Time(8));
  EXPECT_EQ(reading.stamp, 7.5);
  EXPECT_EQ(reading.width, 0.02);
  EXPECT_FALSE(reading.moving);
  EXPECT_TRUE(reading.stalled);
}

TEST(ActionOutcome, ComesBackFromItsCode) {
  for (const ActionOutcome outcome :
       {ActionOutcome::kDone, ActionOutcome::kUnreachable, ActionOutcome::kInCollision,
        ActionOutcome::kGraspLost, ActionOutcome::kCancelled, ActionOutcome::kFault})
    EXPECT_EQ(outcomeOf(codeOf(outcome)), outcome) << toString(outcome);
}

TEST(ActionOutcome, OfAnUnknownCodeIsAFault) { EXPECT_EQ(outcomeOf(77), ActionOutcome::kFault); }

}  // namespace
}  // namespace monocular_eye_hand
