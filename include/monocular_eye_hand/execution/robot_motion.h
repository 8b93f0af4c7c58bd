#pragma once
#include <functional>
#include <string>

#include "monocular_eye_hand/arm/action_outcome.h"
#include "monocular_eye_hand/execution/options.h"
#include "monocular_eye_hand/execution/robot.h"
#include "monocular_eye_hand/execution/trajectory_monitor.h"

namespace monocular_eye_hand {

/// How a motion of arm or gripper ended: done, cancelled, with the grasp lost, or a fault.
struct MotionResult {
  ActionOutcome outcome = ActionOutcome::kDone;
  std::string reason;  ///< when not done
  bool done() const { return outcome == ActionOutcome::kDone; }
};

/// What runs beside a motion.
struct MotionMonitor {
  std::function<bool()> cancelled;
  std::function<void(double progress)> reportProgress;  ///< about every period; may be empty
  /// Why what is carried is lost; "" while it is not. Asked while the arm moves; may be empty.
  std::function<std::string(const GripperReading&)> lost;
};

/// What is wrong with a robot that tells nothing for longer than the options allow; "" while it tells.
std::string missingJoints(const Robot& robot, const RobotState& state, const ExecutionOptions& options);
std::string missingGripper(const Robot& robot, const RobotState& state, const ExecutionOptions& options);

/// Single motions of arm and gripper. Calls block. Whenever a motion ends otherwise than done the arm was
/// told to stop, and was waited for.
class RobotMotion {
 public:
  /// `robot` must outlive it. `feedback_period`: between two reports of progress [s, wall clock].
  RobotMotion(Robot* robot, const ExecutionOptions& options, double feedback_period);

  /// Where arm and gripper are. Wait for the first state; throw BadInput naming its source when it is silent.
  JointVector joints() const;
  GripperReading gripper() const;
  double jointStamp() const;  ///< of the last joint state [s]; 0: none came

  /// A trajectory of one point or none is done at once.
  MotionResult follow(const Trajectory& trajectory, const MotionMonitor& monitor);
  /// To this opening [m]. A cancelled opening is finished first: fingers take a second.
  MotionResult openGripper(double width, const MotionMonitor& monitor);
  /// Until something stops the fingers or they are closed that far [m]; what is between them says gripper().
  MotionResult closeGripper(double width, const MotionMonitor& monitor);

  double clock() const { return robot_.clock(); }     ///< of the robot [s]
  double motionTime() const { return motion_time_; }  ///< of that clock since resetMotionTime() [s]
  void resetMotionTime() { motion_time_ = 0; }

 private:
  struct Check {
    bool ended = false;
    MotionResult result;
  };
  Check checkFollowing(const TrajectoryMonitor& trajectory, const MotionMonitor& monitor);
  Check checkFingers(double width, bool closing, double from) const;
  MotionResult moveFingers(double width, bool closing, const MotionMonitor& monitor);
  MotionResult waitForFingers(double width, bool closing, double start, const MotionMonitor& monitor);
  std::string stop();
  MotionResult stopped(ActionOutcome outcome, const std::string& reason);

  Robot& robot_;
  const ExecutionOptions options_;
  const double feedback_period_;
  double motion_time_ = 0;
};

}  // namespace monocular_eye_hand
