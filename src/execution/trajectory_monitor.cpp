#include "monocular_eye_hand/execution/trajectory_monitor.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace monocular_eye_hand {
namespace {

constexpr double kStep = 0.01;   // of the search along the trajectory [s]
constexpr double kAhead = 0.05;  // a stamp may be so much older than the state it tells [s]

double apart(const JointVector& a, const JointVector& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// "joint3" of the joint that is farthest off.
std::string farthest(const JointVector& a, const JointVector& b) {
  int joint = 0;
  (a - b).cwiseAbs().maxCoeff(&joint);
  return "joint" + std::to_string(joint + 1);
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
  double best = at_, least = off(at_);
  for (double t = at_ + kStep; t < latest + kStep; t += kStep) {
    const double at = std::min(t, latest);
    if (off(at) < least) {
      best = at;
      least = off(at);
    }
  }
  at_ = std::max(at_, best);
}

TrajectoryMonitor::State TrajectoryMonitor::update(double stamp, const JointVector& joints, double speed) {
  if (state_ != State::kMoving || stamp < start_) return state_;
  advance(stamp, joints);
  std::ostringstream text;
  text.precision(3);
  const JointVector meant = trajectory_.sample(at_).position;
  if (const double off = apart(meant, joints); off > options_.deviation) {
    text << farthest(meant, joints) << " is " << off << " rad off the planned path (" << options_.deviation
         << " allowed)";
    return fail(text.str());
  }

  const double duration = trajectory_.duration(), since = stamp - start_;
  const JointVector goal = trajectory_.sample(duration).position;
  const double rest = apart(goal, joints);
  if (since >= duration && rest <= options_.goal_tolerance && speed <= options_.stand_speed)
    return state_ = State::kArrived;

  if (since - at_ > options_.lag && at_ < duration) {
    text << "the arm is " << since - at_ << " s behind the plan (" << options_.lag << " allowed)";
    return fail(text.str());
  }
  if (since > duration + options_.settle) {
    text << "the arm did not come to rest at its goal: " << farthest(goal, joints) << " is " << rest
         << " rad off, " << speed << " rad/s fast, " << since - duration << " s after its time";
    return fail(text.str());
  }
  return state_;
}

}  // namespace monocular_eye_hand
