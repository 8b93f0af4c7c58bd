#include "monocular_eye_hand/task/world.h"

#include "monocular_eye_hand/geometry/length_text.h"

namespace monocular_eye_hand {

TaskGrip gripOf(const GripperReading& gripper, double holding_width) {
  TaskGrip grip;
  grip.known = true;
  grip.holding = gripper.holds(holding_width);
  grip.reason = "width " + millimetresText(gripper.width) + (gripper.stalled ? ", stalled" : "");
  return grip;
}

}  // namespace monocular_eye_hand
