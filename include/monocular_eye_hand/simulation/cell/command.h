#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/simulation/cell/motion.h"

namespace monocular_eye_hand {

/// A trajectory as it comes from outside, as trajectory_msgs/JointTrajectory has it; nothing is checked yet.
struct JointCommand {
  struct Point {
    double time = 0;  ///< from the start [s]
    std::vector<double> positions, velocities, accelerations;
  };
  double stamp = 0;  ///< when it starts, in cell time [s]; 0: at once
  std::vector<std::string> joint_names;
  std::vector<Point> points;
};

/// What the arm shall do from `start` on; an empty path stops it.
struct ArmCommand {
  double start = 0;  ///< cell time [s]
  std::vector<CellPathPoint> path;
};

/// Understands a trajectory as ros_control's joint_trajectory_controller does: joints in any order, a stamp
/// in the future waits, stamp 0 starts at once, points that lie in the past are left out, no points stop the
/// arm. `now`: cell time [s]. Throws BadInput, saying what is wrong, unless all six joints are named once
/// each and every point has six positions, six or no velocities and accelerations, finite, at growing times;
/// and when the whole trajectory lies in the past.
ArmCommand armCommand(const JointCommand& trajectory, double now);

}  // namespace monocular_eye_hand
