#pragma once
#include <array>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/puma560.h"

namespace monocular_eye_hand {

/// One point of a commanded path, as in trajectory_msgs/JointTrajectoryPoint.
struct CellPathPoint {
  double time = 0;                    ///< from the command's start [s]
  JointVector positions;              ///< [rad]
  std::vector<double> velocities;     ///< [rad/s], 6 or none
  std::vector<double> accelerations;  ///< [rad/s^2], 6 (then velocities too) or none
};

/// A joint that was asked for more than it can do; it did what it can.
struct LimitViolation {
  int joint = 0;  ///< 0..5
  enum class Kind { kPosition, kVelocity } kind = Kind::kPosition;
  double wanted = 0, limit = 0;  ///< [rad] or [rad/s]
};

/// Six joints that follow a commanded path exactly, within their limits.
class JointMotion {
 public:
  /// Throws BadInput when `start` is outside the position limits.
  JointMotion(const Puma560Options& arm, const JointVector& start);

  /// Replaces what was commanded before. The path runs from the present position and velocity; between points
  /// with velocities it is cubic, with accelerations too quintic, else linear (joint_trajectory_controller's
  /// rule); after the last point the arm stands. An empty path stops every joint at its deceleration. Throws
  /// BadInput when times do not increase or a number is missing or not finite; the old command then goes on.
  void command(const std::vector<CellPathPoint>& path);
  /// Moves for `dt` [s]; returns what was clipped, at most one entry per joint and kind.
  std::vector<LimitViolation> advance(double dt);

  const JointVector& positions() const { return positions_; }
  const JointVector& velocities() const { return velocities_; }
  bool moving() const { return mode_ != Mode::kStanding; }

 private:
  enum class Mode { kStanding, kFollowing, kStopping };
  void follow(double dt, std::vector<LimitViolation>* violations);
  void stop(double dt, std::vector<LimitViolation>* violations);
  void clipPosition(int joint, std::vector<LimitViolation>* violations);

  std::array<JointLimit, 6> limits_;
  JointVector positions_, velocities_;
  Mode mode_ = Mode::kStanding;
  std::vector<CellPathPoint> path_;  // path_[0]: state when the command came
  double time_ = 0;                  // since then
};

/// Position and velocity of a path at a time; before the first point that point, after the last the last.
void evaluatePath(const std::vector<CellPathPoint>& path, double time, JointVector* positions,
                  JointVector* velocities);

}  // namespace monocular_eye_hand
