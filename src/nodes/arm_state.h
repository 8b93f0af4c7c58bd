#pragma once
#include <sensor_msgs/JointState.h>

#include "monocular_eye_hand/arm/puma560.h"

namespace monocular_eye_hand {

/// What a joint state says of joint1 to joint6; false when one of them is not in it or not finite.
/// `speeds`: has_speeds tells whether they are given.
struct ArmState {
  double stamp = 0;  ///< [s]
  JointVector joints = JointVector::Zero(), speeds = JointVector::Zero();
  bool has_speeds = false;
};
bool armState(const sensor_msgs::JointState& message, ArmState* state);

}  // namespace monocular_eye_hand
