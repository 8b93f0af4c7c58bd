#include "nodes/arm_state.h"

#include <algorithm>
#include <iterator>

#include "nodes/names.h"

namespace monocular_eye_hand {

bool armState(const sensor_msgs::JointState& message, ArmState* state) {
  ArmState result;
  result.stamp = message.header.stamp.toSec();
  result.has_speeds = message.velocity.size() == message.name.size();
  for (int i = 0; i < 6; ++i) {
    const auto found = std::find(message.name.begin(), message.name.end(), names::kArmJoints[i]);
    const size_t at = size_t(found - message.name.begin());
    if (at >= message.position.size()) return false;
    result.joints[i] = message.position[at];
    if (result.has_speeds) result.speeds[i] = message.velocity[at];
  }
  if (!result.joints.allFinite() || !result.speeds.allFinite()) return false;
  *state = result;
  return true;
}

}  // namespace monocular_eye_hand
