#include "monocular_eye_hand/execution/robot_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/length_text.h"

namespace monocular_eye_hand {
namespace {

constexpr double kPoll = 0.01;       // [s, wall clock]
constexpr double kLongestStop = 2;   // in time-outs of the wall clock, when the clock stands
constexpr double kStalledFor = 1.0;  // fingers that begin to open may still be said to be stalled [s]
constexpr double kLater = 1e-6;      // a state so much younger than another one is a new one [s]

std::string missingInput(const std::string& source, bool received, double since, double longest) {
  if (!received) return "no " + source + " yet: does the driver of the arm run?";
  if (since <= longest) return "";
  return fmt::format("{} is silent for {:.3g} s", source, since);
}

/// Now, by the latest of three witnesses: they come by ways of their own, the clock may be last.
double latest(double clock, const RobotState& state) {
  const double joints = state.joints ? state.joints->stamp : 0.0;
  const double gripper = state.gripper ? state.gripper->stamp : 0.0;
  return std::max({clock, joints, gripper});
}

}  // namespace

std::string missingJoints(const Robot& robot, const RobotState& state, const ExecutionOptions& options) {
  return missingInput(robot.jointSource(), state.joints.has_value(), state.joint_silence,
                      options.joint_silence);
}

std::string missingGripper(const Robot& robot, const RobotState& state, const ExecutionOptions& options) {
  return missingInput(robot.gripperSource(), state.gripper.has_value(), state.gripper_silence,
                      options.gripper_silence);
}

RobotMotion::RobotMotion(Robot* robot, const ExecutionOptions& options, double feedback_period)
    : robot_(*robot), options_(options), feedback_period_(feedback_period) {}

JointVector RobotMotion::joints() const {
  const double begin = robot_.wallClock();
  while (!robot_.state().joints && robot_.wallClock() - begin < options_.joint_silence) robot_.wait(kPoll);

  const RobotState state = robot_.state();
  const std::string silent = missingJoints(robot_, state, options_);
  if (!silent.empty()) throw BadInput(silent);
  return state.joints->joints;
}

GripperReading RobotMotion::gripper() const {
  const double begin = robot_.wallClock();
  while (!robot_.state().gripper && robot_.wallClock() - begin < options_.gripper_silence) robot_.wait(kPoll);

  const RobotState state = robot_.state();
  const std::string silent = missingGripper(robot_, state, options_);
  if (!silent.empty()) throw BadInput(silent);
  return *state.gripper;
}

double RobotMotion::jointStamp() const {
  const RobotState state = robot_.state();
  return state.joints ? state.joints->stamp : 0;
}

/// Tells the arm to stop and waits until it stands. What went wrong with that, or "".
std::string RobotMotion::stop() {
  const Instant begin = robot_.now();
  robot_.sendStop();
  RobotState state = robot_.state();
  const double from = std::max(begin.clock, state.joints ? state.joints->stamp + kLater : 0.0);

  while (robot_.connected()) {
    state = robot_.state();
    const bool received = state.joints && state.joints->stamp >= from;
    if (received && state.joints->speed <= options_.follow.stand_speed) return "";
    // Whoever cancels while the clock stands, or ends the program, does not wait for ever.
    const double wall = robot_.wallClock() - begin.wall;
    if (robot_.since(begin) > options_.stop_timeout || wall > kLongestStop * options_.stop_timeout) break;
    robot_.wait(kPoll);
  }
  const std::string silent = missingJoints(robot_, robot_.state(), options_);
  return silent.empty() ? "the arm does not stop" : silent + ": whether the arm stopped is not known";
}

MotionResult RobotMotion::stopped(ActionOutcome outcome, const std::string& reason) {
  const std::string trouble = stop();
  if (trouble.empty()) return {outcome, reason};
  return {ActionOutcome::kFault, outcome == ActionOutcome::kFault ? reason : reason + "; " + trouble};
}

/// Whether the motion goes on; when it does not, the arm stands.
RobotMotion::Check RobotMotion::checkFollowing(const TrajectoryMonitor& trajectory,
                                               const MotionMonitor& monitor) {
  const RobotState state = robot_.state();
  if (!robot_.connected() || monitor.cancelled())
    return {true, stopped(ActionOutcome::kCancelled, "cancelled")};
  if (trajectory.state() == TrajectoryMonitor::State::kFailed)
    return {true, stopped(ActionOutcome::kFault, trajectory.reason())};
  if (const std::string silent = missingJoints(robot_, state, options_); !silent.empty())
    return {true, stopped(ActionOutcome::kFault, silent)};

  if (monitor.lost) {
    if (const std::string silent = missingGripper(robot_, state, options_); !silent.empty())
      return {true, stopped(ActionOutcome::kFault, silent)};
    if (const std::string lost = monitor.lost(*state.gripper); !lost.empty())
      return {true, stopped(ActionOutcome::kGraspLost, lost)};
  }
  return {trajectory.state() == TrajectoryMonitor::State::kArrived, {}};
}

MotionResult RobotMotion::follow(const Trajectory& trajectory, const MotionMonitor& monitor) {
  if (trajectory.points.size() < 2) return {};
  const double start = robot_.clock();
  robot_.takeJoints();  // what came before is no part of this motion
  TrajectoryMonitor following(trajectory, latest(start, robot_.state()), options_.follow);
  robot_.send(trajectory);

  std::optional<double> reported;
  Check check;
  while (!check.ended) {
    for (const JointReading& reading : robot_.takeJoints())
      following.update(reading.stamp, reading.joints, reading.speed);
    check = checkFollowing(following, monitor);

    const bool due = !reported || robot_.wallClock() - *reported > feedback_period_;
    if (monitor.reportProgress && (check.ended || due)) {
      monitor.reportProgress(following.progress());
      reported = robot_.wallClock();
    }
    if (!check.ended) robot_.wait(kPoll);
  }
  motion_time_ += robot_.clock() - start;
  return check.result;
}

MotionResult RobotMotion::openGripper(double width, const MotionMonitor& monitor) {
  return moveFingers(width, false, monitor);
}

MotionResult RobotMotion::closeGripper(double width, const MotionMonitor& monitor) {
  return moveFingers(width, true, monitor);
}

MotionResult RobotMotion::moveFingers(double width, bool closing, const MotionMonitor& monitor) {
  const double start = robot_.clock();
  if (monitor.reportProgress) monitor.reportProgress(0);
  MotionResult result = waitForFingers(width, closing, start, monitor);
  motion_time_ += robot_.clock() - start;
  if (!result.done()) return result;

  if (monitor.reportProgress) monitor.reportProgress(1);
  if (!robot_.connected() || monitor.cancelled()) return {ActionOutcome::kCancelled, "cancelled"};
  return {};
}

MotionResult RobotMotion::waitForFingers(double width, bool closing, double start,
                                         const MotionMonitor& monitor) {
  const Instant begin = robot_.now();
  robot_.sendGripper(width);
  const double from = latest(start, robot_.state());

  while (robot_.connected()) {
    const Check check = checkFingers(width, closing, from);
    if (check.ended) return check.result;
    if (robot_.since(begin) > options_.gripper_timeout)
      return {ActionOutcome::kFault, "the gripper did not go to " + millimetresText(width) +
                                         " in time: it stands at " +
                                         millimetresText(robot_.state().gripper->width)};
    const double wall = robot_.wallClock() - begin.wall;
    if (wall > kLongestStop * options_.gripper_timeout && monitor.cancelled())
      return {ActionOutcome::kFault, "cancelled; the clock stands: whether the fingers moved is not known"};
    robot_.wait(kPoll);
  }
  return {};
}

/// Whether the fingers that were sent to `width` at `from` are there, or will never be.
RobotMotion::Check RobotMotion::checkFingers(double width, bool closing, double from) const {
  const RobotState state = robot_.state();
  if (const std::string silent = missingGripper(robot_, state, options_); !silent.empty())
    return {true, {ActionOutcome::kFault, silent}};

  const GripperReading& gripper = *state.gripper;
  const double since = gripper.stamp - from;
  const bool there = std::abs(gripper.width - width) <= options_.open_tolerance;
  if (since > 0 && !gripper.moving && (there || (closing && gripper.stalled))) return {true, {}};
  if (since > kStalledFor && !closing && !gripper.moving && gripper.stalled)
    return {true,
            {ActionOutcome::kFault, "something keeps the fingers from opening: they are stalled at " +
                                        millimetresText(gripper.width)}};
  return {};
}

}  // namespace monocular_eye_hand
