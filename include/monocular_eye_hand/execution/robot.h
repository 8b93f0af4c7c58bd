#pragma once
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/gripper_reading.h"
#include "monocular_eye_hand/planning/trajectory.h"

namespace monocular_eye_hand {

/// Where the arm was at a moment of the clock.
struct JointReading {
  double stamp = 0;                          ///< of the clock [s]
  JointVector joints = JointVector::Zero();  ///< [rad]
  double speed = 0;                          ///< of the fastest joint [rad/s]
};

/// Readings that nobody takes are kept up to so many, the latest: seconds of a fast arm.
constexpr size_t kMaxUntakenJoints = 2000;

/// The last that arm and gripper told, and for how long they have been silent since; none: nothing came yet.
struct RobotState {
  std::optional<JointReading> joints;
  std::optional<GripperReading> gripper;
  double joint_silence = 0;    ///< by Robot::since() [s]
  double gripper_silence = 0;  ///< by Robot::since() [s]
};

/// A moment of both clocks.
struct Instant {
  double clock = 0;  ///< [s]
  double wall = 0;   ///< [s]
};

/// The lines to an arm with its gripper, real or not. All but wait() returns at once, and nothing throws.
/// One thread calls; what comes from the robot may come in others.
class Robot {
 public:
  virtual ~Robot() = default;

  /// To be followed from now on, instead of what went before.
  virtual void send(const Trajectory& trajectory) = 0;
  /// The arm shall stop where it is.
  virtual void sendStop() = 0;
  /// The fingers shall go to this width [m].
  virtual void sendGripper(double width) = 0;

  virtual RobotState state() const = 0;
  /// What the arm told since the last call, the oldest first. A robot may forget what is older than seconds.
  virtual std::vector<JointReading> takeJoints() = 0;

  /// Of the robot, which may be simulated, stand, or come late [s].
  virtual double clock() const = 0;
  /// Goes on whatever the robot does [s].
  virtual double wallClock() const = 0;
  /// How long ago that was, as silences and time-outs are counted: a robot whose clock stands is not silent
  /// [s].
  virtual double since(const Instant& instant) const = 0;
  /// Until something new is told, at most so long [s, wall clock].
  virtual void wait(double seconds) = 0;
  /// False as soon as the lines to the robot are cut: nothing that is sent arrives.
  virtual bool connected() const = 0;

  /// What the states come by, for messages.
  virtual std::string jointSource() const = 0;
  virtual std::string gripperSource() const = 0;

  Instant now() const { return {clock(), wallClock()}; }
};

}  // namespace monocular_eye_hand
