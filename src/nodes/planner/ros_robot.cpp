#include "nodes/planner/ros_robot.h"

#include <std_msgs/Float64.h>
#include <trajectory_msgs/JointTrajectory.h>

#include "nodes/common/moment.h"
#include "nodes/common/names.h"
#include "nodes/planner/conversion.h"

namespace monocular_eye_hand {

RosRobot::RosRobot() {
  arm_command_ = node_.advertise<trajectory_msgs::JointTrajectory>(names::kArmCommand, 10);
  gripper_command_ = node_.advertise<std_msgs::Float64>(names::kGripperCommand, 10);
}

void RosRobot::send(const Trajectory& trajectory) { arm_command_.publish(toMessage(trajectory)); }

void RosRobot::sendStop() { arm_command_.publish(toMessage(Trajectory())); }  // an empty one

void RosRobot::sendGripper(double width) {
  std_msgs::Float64 command;
  command.data = width;
  gripper_command_.publish(command);
}

double RosRobot::since(const Instant& instant) const {
  return Moment(ros::WallTime(instant.wall), ros::Time(instant.clock)).since();
}

std::string RosRobot::jointSource() const { return names::kJointStates; }

std::string RosRobot::gripperSource() const { return names::kGripperState; }

}  // namespace monocular_eye_hand
