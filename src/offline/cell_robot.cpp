#include "offline/cell_robot.h"

#include <algorithm>
#include <utility>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr double kInstant = 1e-9;  // the cell's time is whole nanoseconds [s]

std::vector<CellPathPoint> pathOf(const Trajectory& trajectory) {
  std::vector<CellPathPoint> path;
  for (size_t k = 1; k < trajectory.points.size(); ++k) {  // the first is where the arm stands
    const TrajectoryState& state = trajectory.points[k];
    CellPathPoint point;
    point.time = state.time_s;
    point.positions = state.position;
    point.velocities.assign(state.velocity.data(), state.velocity.data() + 6);
    path.push_back(std::move(point));
  }
  return path;
}

}  // namespace

GripperReading gripperOf(const WorkCell& cell) {
  return {cell.time(), cell.gripperWidth(), cell.gripperMoving(), cell.gripperStalled()};
}

CellRobot::CellRobot(WorkCell* cell, double period) : cell_(*cell), period_(period) { recordState(); }

void CellRobot::send(const Trajectory& trajectory) {
  try {
    cell_.commandArm(pathOf(trajectory));
  } catch (const BadInput&) {
    // The arm goes on as it was told before, and whoever watches it sees that.
  }
}

void CellRobot::sendStop() { cell_.commandArm({}); }

void CellRobot::sendGripper(double width) {
  try {
    cell_.commandGripper(width);
  } catch (const BadInput&) {
    // The fingers stay, and whoever waits for them runs out of time.
  }
}

RobotState CellRobot::state() const {
  RobotState state;
  state.joints = joints_;
  state.gripper = gripper_;
  state.joint_silence = state.gripper_silence = cell_.time() - joints_.stamp;
  return state;
}

std::vector<JointReading> CellRobot::takeJoints() { return std::exchange(untaken_, {}); }

void CellRobot::wait(double seconds) {
  cell_.advance(std::clamp(next_ - cell_.time(), 0.0, seconds));
  if (cell_.time() + kInstant >= next_) recordState();
}

void CellRobot::rest(double seconds) {
  const double end = cell_.time() + seconds;
  do {
    wait(period_);
  } while (cell_.time() + kInstant < end);
}

void CellRobot::recordState() {
  next_ = cell_.time() + period_;
  joints_ = {cell_.time(), cell_.joints(), cell_.velocities().cwiseAbs().maxCoeff()};
  gripper_ = gripperOf(cell_);

  untaken_.push_back(joints_);
  if (untaken_.size() > kMaxUntakenJoints) untaken_.erase(untaken_.begin());
}

}  // namespace monocular_eye_hand
