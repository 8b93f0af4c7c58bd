#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/execution/robot.h"
#include "monocular_eye_hand/simulation/cell/work_cell.h"

namespace monocular_eye_hand {

/// Where the fingers of the cell are now.
GripperReading gripperOf(const WorkCell& cell);

/// Arm and gripper of a work cell. They move while somebody waits, in the thread that waits: both clocks are
/// the cell's, and nothing depends on how fast the machine is.
class CellRobot : public Robot {
 public:
  /// `cell` must outlive it. `period`: between two states that it tells [s].
  explicit CellRobot(WorkCell* cell, double period = 0.01);

  void send(const Trajectory& trajectory) override;
  void sendStop() override;
  /// A width that the gripper cannot take is not obeyed, as by a driver that refuses it.
  void sendGripper(double width) override;
  RobotState state() const override;
  std::vector<JointReading> takeJoints() override;
  double clock() const override { return cell_.time(); }
  double wallClock() const override { return cell_.time(); }
  double since(const Instant& instant) const override { return cell_.time() - instant.clock; }
  /// Lets cell time pass until the next state is told, at most so long.
  void wait(double seconds) override;
  bool connected() const override { return true; }
  std::string jointSource() const override { return "the work cell's arm"; }
  std::string gripperSource() const override { return "the work cell's gripper"; }

  /// Lets cell time pass, at least until the next state is told [s].
  void rest(double seconds);

 private:
  void recordState();

  WorkCell& cell_;
  const double period_;
  double next_ = 0;  // cell time at which it tells the next state [s]
  JointReading joints_;
  GripperReading gripper_;
  std::vector<JointReading> untaken_;
};

}  // namespace monocular_eye_hand
