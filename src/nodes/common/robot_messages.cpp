#include "nodes/common/robot_messages.h"

#include "nodes/common/stamps.h"

namespace monocular_eye_hand {

JointSample fromMessage(const sensor_msgs::JointState& message, const ros::Time& now) {
  return {nanoseconds(stampOr(message.header.stamp, now)), message.name, message.position, message.velocity};
}

GripperReading fromMessage(const GripperState& message, const ros::Time& now) {
  GripperReading reading;
  reading.stamp = stampOr(message.header.stamp, now).toSec();
  reading.width = message.width;
  reading.moving = message.moving;
  reading.stalled = message.stalled;
  return reading;
}

}  // namespace monocular_eye_hand
