#pragma once
#include <monocular_eye_hand/GripperState.h>

#include "monocular_eye_hand/arm/gripper_reading.h"

namespace monocular_eye_hand {

inline GripperReading fromMessage(const GripperState& message) {
  return {message.header.stamp.toSec(), message.width, bool(message.moving), bool(message.stalled)};
}

}  // namespace monocular_eye_hand
