#pragma once
#include <monocular_eye_hand/GripperState.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/arm_state.h"
#include "monocular_eye_hand/execution/robot.h"
#include "nodes/common/moment.h"

namespace monocular_eye_hand {

/// Arm controller and gripper by their topics. Callbacks must run in other threads than the one that calls.
class RosRobot : public Robot {
 public:
  RosRobot();

  void send(const Trajectory& trajectory) override;
  void sendStop() override;
  void sendGripper(double width) override;
  RobotState state() const override;  ///< from any thread
  std::vector<JointReading> takeJoints() override;
  double clock() const override;
  double wallClock() const override;
  double since(const Instant& instant) const override;  ///< as a Moment counts
  void wait(double seconds) override;
  bool connected() const override;
  std::string jointSource() const override;
  std::string gripperSource() const override;

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
  ros::Publisher arm_command_, gripper_command_;
  ros::Subscriber joint_subscriber_, gripper_subscriber_;
};

}  // namespace monocular_eye_hand
