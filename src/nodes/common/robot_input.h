#pragma once
#include <monocular_eye_hand/GripperState.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "monocular_eye_hand/arm/arm_state.h"
#include "monocular_eye_hand/execution/robot.h"
#include "nodes/common/moment.h"

namespace monocular_eye_hand {

/// What arm and gripper tell: joint_states and gripper/state. Callbacks must run in other threads than the
/// one that waits; all else may be called from any thread.
class RobotInput {
 public:
  RobotInput();

  /// Silences are those of a Moment.
  RobotState state() const;
  /// As Robot::takeJoints().
  std::vector<JointReading> takeJoints();
  /// Until a message came since the last wait, at most so long [s, wall clock].
  void wait(double seconds);

 private:
  void onJoints(const sensor_msgs::JointState& message);
  void onGripper(const GripperState& message);

  mutable std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  size_t changes_ = 0, seen_ = 0;  // messages that came; those that wait() let pass
  ArmStates arm_states_;
  std::optional<JointReading> joints_;
  std::optional<GripperReading> gripper_;
  std::deque<JointReading> untaken_;
  Moment joints_at_, gripper_at_;

  ros::NodeHandle node_;
  ros::Subscriber joint_subscriber_, gripper_subscriber_;
};

}  // namespace monocular_eye_hand
