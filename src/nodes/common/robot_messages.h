#pragma once
#include <monocular_eye_hand/GripperState.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>

#include <cstdint>

#include "monocular_eye_hand/arm/action_outcome.h"
#include "monocular_eye_hand/arm/gripper_reading.h"
#include "monocular_eye_hand/arm/joint_sample.h"

namespace monocular_eye_hand {

/// What arm and gripper tell. A message without stamp counts as of `now`.
JointSample fromMessage(const sensor_msgs::JointState& message, const ros::Time& now);
GripperReading fromMessage(const GripperState& message, const ros::Time& now);

/// The number of an outcome in the results of Pick, Place, Move and Recover, which is the same in all four.
uint8_t codeOf(ActionOutcome outcome);
/// A number that none of them has is a fault.
ActionOutcome outcomeOf(uint8_t code);

}  // namespace monocular_eye_hand
