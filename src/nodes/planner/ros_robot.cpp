#include "nodes/planner/ros_robot.h"

#include <std_msgs/Float64.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <chrono>

#include "nodes/common/gripper_reading.h"
#include "nodes/common/names.h"
#include "nodes/planner/conversion.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kMostUntaken = 2000;  // joint readings that nobody takes

}  // namespace

RosRobot::RosRobot() {
  arm_command_ = node_.advertise<trajectory_msgs::JointTrajectory>(names::kArmCommand, 10);
  gripper_command_ = node_.advertise<std_msgs::Float64>(names::kGripperCommand, 10);
  joint_subscriber_ = node_.subscribe(names::kJointStates, 100, &RosRobot::onJoints, this);
  gripper_subscriber_ = node_.subscribe(names::kGripperState, 100, &RosRobot::onGripper, this);
}

void RosRobot::onJoints(const sensor_msgs::JointState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::optional<ArmState> arm = arm_states_.add(message, ros::Time::now().toSec());
  if (!arm) return;  // another device's message, or not yet all of the arm

  JointReading reading{arm->stamp, arm->joints, joints_ ? joints_->speed : 0};
  const double dt = joints_ ? arm->stamp - joints_->stamp : 0;
  if (arm->has_speeds)
    reading.speed = arm->speeds.cwiseAbs().maxCoeff();
  else if (dt > 0)
    reading.speed = (arm->joints - joints_->joints).cwiseAbs().maxCoeff() / dt;

  joints_ = reading;
  joints_at_ = Moment::now();
  untaken_.push_back(reading);
  if (untaken_.size() > kMostUntaken) untaken_.pop_front();
  ++changes_;
  changed_.notify_all();
}

void RosRobot::onGripper(const GripperState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  gripper_ = fromMessage(message);
  gripper_at_ = Moment::now();
  ++changes_;
  changed_.notify_all();
}

void RosRobot::send(const Trajectory& trajectory) { arm_command_.publish(toMessage(trajectory)); }

void RosRobot::sendStop() { arm_command_.publish(toMessage(Trajectory())); }  // an empty one

void RosRobot::sendGripper(double width) {
  std_msgs::Float64 command;
  command.data = width;
  gripper_command_.publish(command);
}

RobotState RosRobot::state() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  RobotState state;
  state.joints = joints_;
  state.gripper = gripper_;
  if (joints_) state.joint_silence = joints_at_.since();
  if (gripper_) state.gripper_silence = gripper_at_.since();
  return state;
}

std::vector<JointReading> RosRobot::takeJoints() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::vector<JointReading> taken(untaken_.begin(), untaken_.end());
  untaken_.clear();
  return taken;
}

double RosRobot::clock() const { return ros::Time::now().toSec(); }

double RosRobot::wallClock() const { return ros::WallTime::now().toSec(); }

double RosRobot::since(const Instant& instant) const {
  return Moment(ros::WallTime(instant.wall), ros::Time(instant.clock)).since();
}

void RosRobot::wait(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return changes_ != seen_; });
  seen_ = changes_;
}

bool RosRobot::connected() const { return ros::ok(); }

std::string RosRobot::jointSource() const { return names::kJointStates; }

std::string RosRobot::gripperSource() const { return names::kGripperState; }

}  // namespace monocular_eye_hand
