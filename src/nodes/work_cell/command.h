#pragma once
#include <trajectory_msgs/JointTrajectory.h>

#include <string>
#include <vector>

#include "monocular_eye_hand/simulation/cell_motion.h"

namespace monocular_eye_hand {

/// What the arm shall do from `start` on; an empty path stops it.
struct ArmCommand {
  double start = 0;  ///< cell time [s]
  std::vector<CellPathPoint> path;
};

/// Reads a trajectory as ros_control's joint_trajectory_controller does: joints in any order, a stamp in the
/// future waits, stamp 0 starts at once, points that lie in the past are left out, no points stop the arm.
/// `now`: cell time [s]. Throws BadInput, saying what is wrong, unless all six joints are named once each and
/// every point has six positions, six or no velocities and accelerations, finite, at growing times; and when
/// the whole trajectory lies in the past.
ArmCommand armCommand(const trajectory_msgs::JointTrajectory& trajectory, double now);

}  // namespace monocular_eye_hand
