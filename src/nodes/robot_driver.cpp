#include "nodes/robot_driver.h"

#include <std_msgs/Float64.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/length_text.h"
#include "nodes/names.h"

namespace monocular_eye_hand {
namespace {

constexpr auto kPoll = std::chrono::milliseconds(10);
constexpr double kLongestStop = 2;   // in time-outs of the wall clock, when the clock stands
constexpr double kStalledFor = 1.0;  // fingers that begin to open may still be said to be stalled [s, cell]

std::string silence(const char* topic, const Moment& last, double longest) {
  if (last.never()) return std::string("no ") + topic + " yet: does the driver of the arm run?";
  const double since = last.since();
  if (since <= longest) return "";
  std::ostringstream text;
  text.precision(3);
  text << topic << " is silent for " << since << " s";
  return text.str();
}

}  // namespace

RobotDriver::RobotDriver(const ExecutionOptions& options, double feedback_period)
    : options_(options), feedback_period_(feedback_period) {
  arm_command_ = node_.advertise<trajectory_msgs::JointTrajectory>(names::kArmCommand, 10);
  gripper_command_ = node_.advertise<std_msgs::Float64>(names::kGripperCommand, 10);
  joint_subscriber_ = node_.subscribe(names::kJointStates, 100, &RobotDriver::onJoints, this);
  gripper_subscriber_ = node_.subscribe(names::kGripperState, 100, &RobotDriver::onGripper, this);
}

void RobotDriver::onJoints(const sensor_msgs::JointState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::optional<ArmState> told = arm_states_.add(message, ros::Time::now().toSec());
  if (!told) return;  // another device's message, or not yet all of the arm
  const ArmState& state = *told;
  const double dt = state_ ? state.stamp - state_->stamp : 0;
  if (state.has_speeds)
    speed_ = state.speeds.cwiseAbs().maxCoeff();
  else if (dt > 0)
    speed_ = (state.joints - state_->joints).cwiseAbs().maxCoeff() / dt;
  state_ = state;
  joints_at_ = Moment::now();
  if (follower_) follower_->update(state.stamp, state.joints, speed_);
  changed_.notify_all();
}

void RobotDriver::onGripper(const GripperState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  gripper_ = message;
  gripper_at_ = Moment::now();
  changed_.notify_all();
}

std::string RobotDriver::silentJoints() const {
  return silence(names::kJointStates, joints_at_, options_.joint_silence);
}
std::string RobotDriver::silentGripper() const {
  return silence(names::kGripperState, gripper_at_, options_.gripper_silence);
}
std::string RobotDriver::jointSilence() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return silentJoints();
}
std::string RobotDriver::gripperSilence() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return silentGripper();
}

double RobotDriver::latest(const ros::Time& clock) const {
  return std::max(
      {clock.toSec(), state_ ? state_->stamp : 0.0, gripper_ ? gripper_->header.stamp.toSec() : 0.0});
}

JointVector RobotDriver::joints() const {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(options_.joint_silence),
                    [&] { return state_.has_value(); });
  const std::string silent = silentJoints();
  if (!silent.empty()) throw BadInput(silent);
  return state_->joints;
}

double RobotDriver::jointStamp() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_ ? state_->stamp : 0;
}

GripperState RobotDriver::gripper() const {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(options_.gripper_silence),
                    [&] { return gripper_.has_value(); });
  const std::string silent = silentGripper();
  if (!silent.empty()) throw BadInput(silent);
  return *gripper_;
}

std::string RobotDriver::stop() {
  const ros::Time told = ros::Time::now();
  trajectory_msgs::JointTrajectory nothing;
  nothing.joint_names.assign(std::begin(names::kArmJoints), std::end(names::kArmJoints));
  arm_command_.publish(nothing);
  const Moment begin = Moment::now();
  const ros::WallTime told_at = ros::WallTime::now();
  std::unique_lock<std::mutex> lock(mutex_);
  const double from = std::max(told.toSec(), state_ ? state_->stamp + 1e-6 : 0.0);
  while (ros::ok()) {
    if (state_ && state_->stamp >= from && speed_ <= options_.follow.stand_speed) return "";
    // Whoever cancels while the clock stands, or ends the node, does not wait for ever.
    const double wall = (ros::WallTime::now() - told_at).toSec();
    if (begin.since() > options_.stop_timeout || wall > kLongestStop * options_.stop_timeout) break;
    changed_.wait_for(lock, kPoll);
  }
  const std::string silent = silentJoints();
  return silent.empty() ? "the arm does not stop" : silent + ": whether the arm stopped is not known";
}

Drive RobotDriver::stopped(ActionOutcome outcome, const std::string& reason) {
  const std::string trouble = stop();
  if (trouble.empty()) return {outcome, reason};
  return {ActionOutcome::kFault, outcome == ActionOutcome::kFault ? reason : reason + "; " + trouble};
}

Drive RobotDriver::follow(const Trajectory& trajectory, const DriveWatch& watch) {
  if (trajectory.points.size() < 2) return {};
  const ros::Time start = ros::Time::now();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    follower_.emplace(trajectory, latest(start), options_.follow);
  }
  arm_command_.publish(toMessage(trajectory));

  Drive drive;
  ros::WallTime told;
  std::unique_lock<std::mutex> lock(mutex_);
  for (bool on = true; on;) {
    const TrajectoryMonitor::State state = follower_->state();
    const std::string silent = silentJoints(), silent_gripper = watch.lost ? silentGripper() : "";
    const std::string lost = watch.lost && gripper_ ? watch.lost(*gripper_) : "";
    const double progress = follower_->progress();
    const std::string failure = follower_->reason();

    lock.unlock();
    on = false;
    if (!ros::ok() || watch.cancelled())
      drive = stopped(ActionOutcome::kCancelled, "cancelled");
    else if (state == TrajectoryMonitor::State::kFailed)
      drive = stopped(ActionOutcome::kFault, failure);
    else if (!silent.empty())
      drive = stopped(ActionOutcome::kFault, silent);
    else if (!silent_gripper.empty())
      drive = stopped(ActionOutcome::kFault, silent_gripper);
    else if (!lost.empty())
      drive = stopped(ActionOutcome::kGraspLost, lost);
    else
      on = state != TrajectoryMonitor::State::kArrived;

    if (watch.feedback && (!on || ros::WallTime::now() - told > feedback_period_)) {
      watch.feedback(progress);
      told = ros::WallTime::now();
    }
    lock.lock();
    if (on) changed_.wait_for(lock, kPoll);
  }

  follower_.reset();
  motion_time_ += (ros::Time::now() - start).toSec();
  return drive;
}

Drive RobotDriver::openGripper(double width, const DriveWatch& watch) {
  return moveFingers(width, false, watch);
}
Drive RobotDriver::closeGripper(double width, const DriveWatch& watch) {
  return moveFingers(width, true, watch);
}

Drive RobotDriver::moveFingers(double width, bool closing, const DriveWatch& watch) {
  const ros::Time start = ros::Time::now();
  const ros::WallTime wall_start = ros::WallTime::now();
  const Moment begin = Moment::now();
  if (watch.feedback) watch.feedback(0);
  std_msgs::Float64 command;
  command.data = width;
  gripper_command_.publish(command);

  const auto fault = [&](const std::string& reason) {
    motion_time_ += (ros::Time::now() - start).toSec();
    return Drive{ActionOutcome::kFault, reason};
  };

  std::unique_lock<std::mutex> lock(mutex_);
  const double from = latest(start);
  while (ros::ok()) {
    const std::string silent = silentGripper();
    if (!silent.empty()) return fault(silent);
    const GripperState& state = *gripper_;
    const double since = state.header.stamp.toSec() - from;
    const bool there = std::abs(state.width - width) <= options_.open_tolerance;
    if (since > 0 && !state.moving && (there || (closing && state.stalled))) break;
    if (since > kStalledFor && !closing && !state.moving && state.stalled)
      return fault("something keeps the fingers from opening: they are stalled at " +
                   millimetresText(state.width));
    if (begin.since() > options_.gripper_timeout)
      return fault("the gripper did not go to " + millimetresText(width) + " in time: it stands at " +
                   millimetresText(state.width));
    const double wall = (ros::WallTime::now() - wall_start).toSec();
    if (wall > kLongestStop * options_.gripper_timeout && watch.cancelled())
      return fault("cancelled; the clock stands: whether the fingers moved is not known");
    changed_.wait_for(lock, kPoll);
  }

  lock.unlock();
  motion_time_ += (ros::Time::now() - start).toSec();
  if (watch.feedback) watch.feedback(1);
  if (!ros::ok() || watch.cancelled()) return {ActionOutcome::kCancelled, "cancelled"};
  return {};
}

}  // namespace monocular_eye_hand
