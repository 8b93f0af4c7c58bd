#pragma once
#include <monocular_eye_hand/GripperState.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "monocular_eye_hand/arm/action_outcome.h"
#include "monocular_eye_hand/execution/trajectory_monitor.h"
#include "nodes/arm_state.h"
#include "nodes/moment.h"
#include "nodes/planner_conversion.h"

namespace monocular_eye_hand {

/// How a motion of arm or gripper ended: done, cancelled, with the grasp lost, or a fault.
struct Drive {
  ActionOutcome outcome = ActionOutcome::kDone;
  std::string reason;  ///< when not done
  bool done() const { return outcome == ActionOutcome::kDone; }
};

/// What runs beside a motion.
struct DriveWatch {
  std::function<bool()> cancelled;
  std::function<void(double progress)> feedback;  ///< about every period
  /// Why what is carried is lost; "" while it is not. Asked while the arm moves; may be empty.
  std::function<std::string(const GripperState&)> lost;
};

/// Arm controller and gripper by their topics. Calls block; callbacks must run in other threads. Whenever a
/// motion ends otherwise than done the arm was told to stop, and was waited for.
class RobotDriver {
 public:
  RobotDriver(const ExecutionOptions& options, double feedback_period);

  /// Where the arm is. Waits for the first message; throws BadInput naming the topic when it is silent.
  JointVector joints() const;
  GripperState gripper() const;
  double jointStamp() const;  ///< of the last joint state [s]; 0: none came

  Drive follow(const Trajectory& trajectory, const DriveWatch& watch);
  /// To this opening. A cancelled opening is finished first: fingers take a second.
  Drive openGripper(double width, const DriveWatch& watch);
  /// Until something stops the fingers or they are closed that far; what is between them says gripper().
  Drive closeGripper(double width, const DriveWatch& watch);

  double motionTime() const { return motion_time_; }  ///< of the clock since resetMotionTime() [s]
  void resetMotionTime() { motion_time_ = 0; }
  std::string jointSilence() const;  ///< "" or what is wrong, for diagnostics
  std::string gripperSilence() const;

 private:
  void onJoints(const sensor_msgs::JointState& message);
  void onGripper(const GripperState& message);
  /// Now, by the latest of three witnesses: they come by ways of their own, the clock may be last. With
  /// mutex_ held.
  double latest(const ros::Time& clock) const;
  std::string silentJoints() const;   // with mutex_ held
  std::string silentGripper() const;  // with mutex_ held
  /// Empty trajectory; waits until the arm stands. What went wrong with that, or "".
  std::string stop();
  Drive stopped(ActionOutcome outcome, const std::string& reason);
  Drive moveFingers(double width, bool closing, const DriveWatch& watch);

  const ExecutionOptions options_;
  const ros::WallDuration feedback_period_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::optional<ArmState> state_;
  double speed_ = 0;  // of the fastest joint [rad/s]
  std::optional<GripperState> gripper_;
  ArmStates arm_states_;
  Moment joints_at_, gripper_at_;
  std::optional<TrajectoryMonitor> follower_;
  double motion_time_ = 0;
  ros::NodeHandle node_;
  ros::Publisher arm_command_, gripper_command_;
  ros::Subscriber joint_subscriber_, gripper_subscriber_;
};

}  // namespace monocular_eye_hand
