#pragma once
#include <string>

#include "monocular_eye_hand/execution/options.h"
#include "monocular_eye_hand/planning/trajectory.h"

namespace monocular_eye_hand {

/// Watches joint states while a trajectory runs: how far it is, whether it arrived, whether something is
/// wrong. The arm may start late and lag: what counts is the path, until the lag is too long.
class TrajectoryMonitor {
 public:
  enum class State { kMoving, kArrived, kFailed };

  /// The command is given at `start` [s]; stamps of earlier joint states do not count.
  TrajectoryMonitor(const Trajectory& trajectory, double start, const FollowOptions& options);
  /// `speed` is the largest of the joints [rad/s].
  State update(double stamp, const JointVector& joints, double speed);
  State state() const { return state_; }
  double progress() const;                               ///< 0..1 of the trajectory's time
  const std::string& reason() const { return reason_; }  ///< why it failed

 private:
  void advance(double stamp, const JointVector& joints);
  State fail(const std::string& reason);

  Trajectory trajectory_;
  double start_;
  FollowOptions options_;
  State state_ = State::kMoving;
  double at_ = 0;  // trajectory time of the joints
  std::string reason_;
};

}  // namespace monocular_eye_hand
