#include "nodes/planner/conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/arm/arm_state.h"
#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/conversion.h"
#include "nodes/common/markers.h"
#include "nodes/common/names.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMarkerStep = 0.02;    // between points of the line [s]
constexpr double kMarkerWidth = 0.003;  // of the line [m]
constexpr double kMarkerLife = 60.0;    // of the line [s]

double widthOf(double value, const char* field, double max_width) {
  if (value >= 0 && value <= max_width + 1e-9) return std::min(value, max_width);
  throw BadInput(fmt::format("target.{} = {:.6g} must be 0 to {:.6g} m, what the gripper can open", field,
                             value, max_width));
}

std::vector<JointVector> jointsOf(const MoveGoal& goal) {
  if (goal.joints.empty()) return {};
  if (goal.joints.size() != 6)
    throw BadInput(fmt::format("joints holds {} angles: give six, or none", goal.joints.size()));
  const JointVector joints = Eigen::Map<const JointVector>(goal.joints.data());
  if (!joints.allFinite()) throw BadInput("joints is not finite");
  return {joints};
}

}  // namespace

trajectory_msgs::JointTrajectory toMessage(const Trajectory& trajectory) {
  trajectory_msgs::JointTrajectory message;
  message.joint_names.assign(armJointNames().begin(), armJointNames().end());
  for (size_t k = 1; k < trajectory.points.size(); ++k) {
    const TrajectoryState& state = trajectory.points[k];
    trajectory_msgs::JointTrajectoryPoint point;
    point.time_from_start = ros::Duration(state.time_s);
    point.positions.assign(state.position.data(), state.position.data() + 6);
    point.velocities.assign(state.velocity.data(), state.velocity.data() + 6);
    message.points.push_back(point);
  }
  return message;
}

PickTarget pickTargetOf(const GraspTarget& target, const std::string& object, double gripper_width_max) {
  PickTarget pick;
  pick.object = object;
  pick.base_from_pregrasp = poseOf(target.pregrasp, "target.pregrasp");
  pick.base_from_grasp = poseOf(target.grasp, "target.grasp");
  pick.base_from_lift = poseOf(target.retreat, "target.retreat");
  pick.opening = widthOf(target.opening, "opening", gripper_width_max);
  pick.part_width = widthOf(target.width, "width", gripper_width_max);
  if (pick.opening < pick.part_width)
    throw BadInput(fmt::format("target.opening = {:.6g} must not be less than width = {:.6g} m",
                               target.opening, target.width));
  return pick;
}

std::vector<Rigid3> tcpPosesOf(const MoveGoal& goal, const ArmDescription& arm) {
  Rigid3 link_from_tcp;
  if (goal.link == "tool0")
    link_from_tcp = arm.tool0_from_tcp;
  else if (goal.link == names::kCameraFrame)
    link_from_tcp = arm.tool0_from_camera.inverse() * arm.tool0_from_tcp;
  else if (goal.link != "gripper_tcp")
    throw BadInput(fmt::format(
        "there is no link '{}' to move: say tool0, gripper_tcp or camera_optical_frame", goal.link));
  if (goal.poses.empty()) throw BadInput("neither poses nor joints: say where to");
  std::vector<Rigid3> poses;
  for (size_t i = 0; i < goal.poses.size(); ++i)
    poses.push_back(poseOf(goal.poses[i], fmt::format("poses[{}]", i)) * link_from_tcp);
  return poses;
}

PickOrder pickOrderOf(const PickGoal& goal, const std::string& base_frame, const SceneMemory& scene,
                      double gripper_width_max) {
  const std::string& frame = goal.target.header.frame_id;
  if (withoutSlash(frame) != base_frame)
    throw BadInput(
        fmt::format("target.header.frame_id is '{}' and must be '{}', the arm's base", frame, base_frame));
  scene.requireKnown(goal.target.name);

  PickOrder order;
  order.object = {goal.target.name, goal.target.instance, poseOf(goal.target.object.pose, "target.object")};
  order.target = pickTargetOf(goal.target, order.object.label(), gripper_width_max);
  order.place = goal.place;
  return order;
}

MoveOrder moveOrderOf(const MoveGoal& goal, const ArmDescription& arm) {
  MoveOrder order;
  order.open_gripper = goal.open_gripper;
  order.joints = jointsOf(goal);
  if (order.joints.empty()) order.base_from_tcp = tcpPosesOf(goal, arm);
  return order;
}

visualization_msgs::Marker pathMarker(const std::string& frame, const ToolArm& arm,
                                      const std::vector<Trajectory>& motions) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame;
  marker.header.stamp = ros::Time::now();
  marker.ns = "path";
  marker.lifetime = ros::Duration(kMarkerLife);
  marker.type = visualization_msgs::Marker::LINE_STRIP;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1;
  marker.scale.x = kMarkerWidth;
  marker.color = toColour(0.1, 0.8, 0.9);

  for (const Trajectory& motion : motions)
    for (double t = 0; t < motion.duration() + kMarkerStep; t += kMarkerStep) {
      const TrajectoryState at = motion.sample(std::min(t, motion.duration()));
      marker.points.push_back(toPoint(arm.baseFromTcp(at.position).translation));
    }
  return marker;
}

}  // namespace monocular_eye_hand
