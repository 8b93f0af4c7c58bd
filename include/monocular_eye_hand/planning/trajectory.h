#pragma once
#include <vector>

#include "monocular_eye_hand/planning/cartesian_path.h"
#include "monocular_eye_hand/planning/path_planner.h"

namespace monocular_eye_hand {

/// Where the joints are at a time, and how they go on: with this acceleration until the next point.
struct TrajectoryState {
  double time_s = 0;
  JointVector position = JointVector::Zero();      ///< [rad]
  JointVector velocity = JointVector::Zero();      ///< [rad/s]
  JointVector acceleration = JointVector::Zero();  ///< [rad/s^2]
};

/// Joint motion of piecewise constant acceleration, at rest at both ends: points with position and velocity
/// give it exactly to whoever joins them by cubics, as ros_control's joint_trajectory_controller does.
struct Trajectory {
  std::vector<TrajectoryState> points;

  double duration() const { return points.empty() ? 0 : points.back().time_s; }
  /// Before the beginning and after the end: at rest there. Throws BadInput on an empty trajectory.
  TrajectoryState sample(double time_s) const;
};

/// Follows the path as fast as the limits of the joints and of gripper_tcp allow: trapezoids along the
/// straight edges, corners cut by parabolas at constant speed (after Kunz & Stilman, RSS 2012) where `test`
/// finds them free, else a stop. A path of one point is a trajectory of one point. Throws BadInput on an
/// empty path, joints that are not finite or outside the limits, or options out of range.
Trajectory timeParameterise(const ToolArm& arm, const std::vector<JointVector>& path, const PathTest& test,
                            const TimingOptions& options = {});

/// The first collision along a trajectory, sampled so that no step turns the joints by more than `resolution`
/// [rad]; an empty first name when there is none.
CollisionPair firstCollision(const CollisionWorld& world, const Trajectory& trajectory, double resolution);

}  // namespace monocular_eye_hand
