#pragma once
#include <geometry_msgs/Pose.h>
#include <monocular_eye_hand/GraspTarget.h>
#include <monocular_eye_hand/MoveAction.h>
#include <monocular_eye_hand/PickAction.h>
#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>
#include <visualization_msgs/Marker.h>

#include <string>
#include <vector>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/execution/orders.h"
#include "monocular_eye_hand/execution/scene_memory.h"

namespace monocular_eye_hand {

/// For a joint_trajectory_controller, to start at once; the first point, where the arm is, is left out.
trajectory_msgs::JointTrajectory toMessage(const Trajectory& trajectory);

/// The grasp of a target whose object is called `object` in the world. Throws BadInput naming what is broken.
PickTarget pickTargetOf(const GraspTarget& target, const std::string& object, double gripper_width_max);

/// Poses of gripper_tcp that put `link` (tool0, gripper_tcp or camera_optical_frame) where a goal wants it.
/// Throws BadInput on another link, no pose or a broken one.
std::vector<Rigid3> tcpPosesOf(const MoveGoal& goal, const ArmDescription& arm);

/// Goals as orders. Throw BadInput naming what is broken: of a pick a target in another frame than
/// `base_frame` or of an object that `scene` does not know, of a move neither six joints nor poses as
/// tcpPosesOf() takes them.
PickOrder pickOrderOf(const PickGoal& goal, const std::string& base_frame, const SceneMemory& scene,
                      double gripper_width_max);
MoveOrder moveOrderOf(const MoveGoal& goal, const ArmDescription& arm);

/// The way of gripper_tcp along trajectories, as a line strip.
visualization_msgs::Marker pathMarker(const std::string& frame, const ToolArm& arm,
                                      const std::vector<Trajectory>& motions);

}  // namespace monocular_eye_hand
