#include "nodes/common/robot_input.h"

#include <chrono>

#include "nodes/common/names.h"
#include "nodes/common/robot_messages.h"

namespace monocular_eye_hand {

RobotInput::RobotInput() {
  joint_subscriber_ = node_.subscribe(names::kJointStates, 100, &RobotInput::onJoints, this);
  gripper_subscriber_ = node_.subscribe(names::kGripperState, 100, &RobotInput::onGripper, this);
}

void RobotInput::onJoints(const sensor_msgs::JointState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::optional<ArmState> arm = arm_states_.add(fromMessage(message, ros::Time::now()));
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
  if (untaken_.size() > kMaxUntakenJoints) untaken_.pop_front();
  ++changes_;
  changed_.notify_all();
}

void RobotInput::onGripper(const GripperState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  gripper_ = fromMessage(message, message.header.stamp);  // without a stamp: of no moment
  gripper_at_ = Moment::now();
  ++changes_;
  changed_.notify_all();
}

RobotState RobotInput::state() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  RobotState state;
  state.joints = joints_;
  state.gripper = gripper_;
  if (joints_) state.joint_silence = joints_at_.since();
  if (gripper_) state.gripper_silence = gripper_at_.since();
  return state;
}

std::vector<JointReading> RobotInput::takeJoints() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::vector<JointReading> taken(untaken_.begin(), untaken_.end());
  untaken_.clear();
  return taken;
}

void RobotInput::wait(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return changes_ != seen_; });
  seen_ = changes_;
}

}  // namespace monocular_eye_hand
