#pragma once
#include <ros/ros.h>

#include <string>
#include <vector>

#include "monocular_eye_hand/execution/robot.h"
#include "nodes/common/robot_input.h"

namespace monocular_eye_hand {

/// Arm controller and gripper by their topics. Callbacks must run in other threads than the one that calls.
class RosRobot : public Robot {
 public:
  RosRobot();

  void send(const Trajectory& trajectory) override;
  void sendStop() override;
  void sendGripper(double width) override;
  RobotState state() const override { return input_.state(); }  ///< from any thread
  std::vector<JointReading> takeJoints() override { return input_.takeJoints(); }
  double clock() const override { return ros::Time::now().toSec(); }
  double wallClock() const override { return ros::WallTime::now().toSec(); }
  double since(const Instant& instant) const override;  ///< as a Moment counts
  void wait(double seconds) override { input_.wait(seconds); }
  bool connected() const override { return ros::ok(); }
  std::string jointSource() const override;
  std::string gripperSource() const override;

 private:
  ros::NodeHandle node_;
  ros::Publisher arm_command_, gripper_command_;
  RobotInput input_;
};

}  // namespace monocular_eye_hand
