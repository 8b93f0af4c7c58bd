#include "monocular_eye_hand/execution/trajectory_monitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

constexpr double kStep = 0.01;   // of the search along the trajectory [s]
constexpr double kAhead = 0.05;  // a stamp may be so much older than the state it tells [s]

double apart(const JointVector& a, const JointVector& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// "joint3" of the joint that is farthest off.
std::string farthest(const JointVector& a, const JointVector& b) {
  int joint = 0;
  (a - b).cwiseAbs().maxCoeff(&joint);
  return fmt::format("joint{}", joint + 1);
}

}  // namespace

TrajectoryMonitor::TrajectoryMonitor(const Trajectory& trajectory, double start, const FollowOptions& options)
    : trajectory_(trajectory), start_(start), options_(options) {}

double TrajectoryMonitor::progress() const {
  const double duration = trajectory_.duration();
  return state_ == State::kArrived || duration <= 0 ? 1 : std::min(1.0, at_ / duration);
}

TrajectoryMonitor::State TrajectoryMonitor::fail(const std::string& reason) {
  reason_ = reason;
  return state_ = State::kFailed;
}

void TrajectoryMonitor::advance(double stamp, const JointVector& joints) {
  const double latest = std::min(trajectory_.duration(), stamp - start_ + kAhead);
  const auto off = [&](double t) { return (trajectory_.sample(t).position - joints).squaredNorm(); };
  double best = at_, min_off = off(at_);
  for (double t = at_ + kStep; t < latest + kStep; t += kStep) {
    const double at = std::min(t, latest);
    if (off(at) < min_off) {
      best = at;
      min_off = off(at);
    }
  }
  at_ = std::max(at_, best);
}

TrajectoryMonitor::State TrajectoryMonitor::update(double stamp, const JointVector& joints, double speed) {
  if (state_ != State::kMoving || stamp < start_) return state_;
  advance(stamp, joints);
  const JointVector meant = trajectory_.sample(at_).position;
  if (const double off = apart(meant, joints); off > options_.deviation) {
    return fail(fmt::format("{} is {:.3g} rad off the planned path ({:.3g} allowed)", farthest(meant, joints),
                            off, options_.deviation));
  }

  const double duration = trajectory_.duration(), since = stamp - start_;
  const JointVector goal = trajectory_.sample(duration).position;
  const double rest = apart(goal, joints);
  if (since >= duration && rest <= options_.goal_tolerance && speed <= options_.stand_speed)
    return state_ = State::kArrived;

  if (since - at_ > options_.lag && at_ < duration) {
    return fail(
        fmt::format("the arm is {:.3g} s behind the plan ({:.3g} allowed)", since - at_, options_.lag));
  }
  if (since > duration + options_.settle) {
    return fail(fmt::format(
        "the arm did not come to rest at its goal: {} is {:.3g} rad off, {:.3g} rad/s fast, {:.3g} s after "
        "its time",
        farthest(goal, joints), rest, speed, since - duration));
  }
  return state_;
}

}  // namespace monocular_eye_hand
