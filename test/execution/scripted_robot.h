#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/execution/robot.h"

namespace monocular_eye_hand {

/// An arm that follows every trajectory exactly and fingers that close on what is between them, in a time of
/// their own: each wait() is a step of it. What goes wrong is scripted by the fields, at once or from
/// on_step.
class ScriptedRobot : public Robot {
 public:
  JointVector joints = JointVector::Zero();
  double width = 0.05;        ///< between the pads [m]
  double part_width = 0;      ///< of what is between them [m]; 0: nothing is
  double widest_opening = 1;  ///< something keeps the fingers from opening further [m]
  bool tells_joints = true, tells_gripper = true;
  bool follows = true;  ///< false: the arm does not move
  bool stops = true;    ///< false: it moves on when it is told to stop
  bool clock_runs = true;
  bool is_connected = true;
  double offset = 0;  ///< joint 3 is so far off the trajectory [rad]
  std::function<void()> on_step;

  std::vector<Trajectory> sent;     ///< trajectories
  std::vector<double> sent_widths;  ///< [m]
  int sent_stops = 0;
  std::vector<std::string> commands;  ///< "arm", "stop" and "gripper" in their order

  ScriptedRobot() { recordState(); }

  void send(const Trajectory& trajectory) override {
    commands.push_back("arm");
    sent.push_back(trajectory);
    begin_ = clock_;
    going_ = true;
    stopped_ = false;
  }
  void sendStop() override {
    commands.push_back("stop");
    ++sent_stops;
    stopped_ = true;
    if (stops) going_ = false;
  }
  void sendGripper(double wanted) override {
    commands.push_back("gripper");
    sent_widths.push_back(wanted);
    wanted_ = wanted;
  }

  RobotState state() const override {
    RobotState state;
    state.joints = told_joints_;
    state.gripper = told_gripper_;
    state.joint_silence = since(joints_at_);
    state.gripper_silence = since(gripper_at_);
    return state;
  }
  std::vector<JointReading> takeJoints() override {
    std::vector<JointReading> taken;
    std::swap(taken, untaken_);
    return taken;
  }

  double clock() const override { return clock_; }
  double wallClock() const override { return wall_; }
  double since(const Instant& instant) const override {
    return std::min(clock_ - instant.clock, wall_ - instant.wall);
  }
  void wait(double seconds) override {
    wall_ += seconds;
    if (on_step) on_step();
    if (!clock_runs) return;
    clock_ += seconds;
    moveArm();
    moveFingers(seconds);
    recordState();
  }
  bool connected() const override { return is_connected; }
  std::string jointSource() const override { return "joint_states"; }
  std::string gripperSource() const override { return "gripper/state"; }

  bool stands() const { return speed_ == 0; }
  /// As before the first message.
  void forgetAll() {
    told_joints_.reset();
    told_gripper_.reset();
    untaken_.clear();
  }

 private:
  static constexpr double kFingerSpeed = 0.1;  // [m/s]
  static constexpr double kUnstoppable = 0.5;  // of an arm that does not stop [rad/s]

  void moveArm() {
    speed_ = 0;
    if (going_ && follows) {
      const double time = clock_ - begin_;
      const TrajectoryState at = sent.back().sample(time);
      joints = at.position;
      joints[2] += offset;
      speed_ = at.velocity.cwiseAbs().maxCoeff();
      going_ = time < sent.back().duration();
    }
    if (stopped_ && !stops) speed_ = kUnstoppable;
  }

  void moveFingers(double seconds) {
    const double closest = std::max(wanted_.value_or(width), part_width);
    const double goal = wanted_ ? std::min(closest, widest_opening) : width;
    const double step = kFingerSpeed * seconds;
    const double before = width;
    width = goal > width ? std::min(goal, width + step) : std::max(goal, width - step);
    moving_ = width != before;
    stalled_ = !moving_ && wanted_ && std::abs(width - *wanted_) > 1e-6;
  }

  void recordState() {
    if (tells_joints) {
      told_joints_ = JointReading{clock_, joints, speed_};
      untaken_.push_back(*told_joints_);
      joints_at_ = now();
    }
    if (tells_gripper) {
      told_gripper_ = GripperReading{clock_, width, moving_, stalled_};
      gripper_at_ = now();
    }
  }

  double clock_ = 1000, wall_ = 5000;  // [s]
  double begin_ = 0;                   // of the trajectory [s]
  double speed_ = 0;                   // [rad/s]
  bool stopped_ = false, going_ = false;
  bool moving_ = false, stalled_ = false;
  std::optional<double> wanted_;
  std::optional<JointReading> told_joints_;
  std::optional<GripperReading> told_gripper_;
  std::vector<JointReading> untaken_;
  Instant joints_at_, gripper_at_;
};

}  // namespace monocular_eye_hand
