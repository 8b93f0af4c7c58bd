#include "nodes/planner/memory.h"

#include <XmlRpcException.h>
#include <ros/console.h>
#include <ros/master.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include <string>

namespace monocular_eye_hand {
namespace {

using Value = XmlRpc::XmlRpcValue;

std::string parameterName() { return ros::this_node::getName() + "_memory"; }

/// Rotation row by row, then translation.
Value toParameter(const Rigid3& pose) {
  Value list;
  list.setSize(12);
  for (int k = 0; k < 9; ++k) list[k] = pose.rotation(k / 3, k % 3);
  for (int k = 0; k < 3; ++k) list[9 + k] = pose.translation[k];
  return list;
}

Rigid3 poseOf(Value& list) {
  Rigid3 pose;
  for (int k = 0; k < 9; ++k) pose.rotation(k / 3, k % 3) = double(list[k]);
  for (int k = 0; k < 3; ++k) pose.translation[k] = double(list[9 + k]);
  return pose;
}

bool isRotation(const Eigen::Matrix3d& rotation) {
  return (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6 &&
         rotation.determinant() > 0;
}

}  // namespace

Value toParameter(const PickMemory& memory) {
  Value value;
  value["name"] = memory.object.name;
  value["instance"] = memory.object.instance;
  value["base_from_object"] = toParameter(memory.object.base_from_object);
  // These names stay: what a planner of another version left must be read.
  value["base_from_tcp_before"] = toParameter(memory.target.base_from_pregrasp);
  value["base_from_tcp_grasp"] = toParameter(memory.target.base_from_grasp);
  value["base_from_tcp_after"] = toParameter(memory.target.base_from_lift);
  value["open_width"] = memory.target.opening;
  value["grip_width"] = memory.target.part_width;
  value["stamp"] = memory.stamp;
  return value;
}

std::optional<PickMemory> fromParameter(Value value) {
  PickMemory memory;
  try {
    memory.object.name = std::string(value["name"]);
    memory.object.instance = int(value["instance"]);
    memory.object.base_from_object = poseOf(value["base_from_object"]);
    memory.target.object = memory.object.label();
    memory.target.base_from_pregrasp = poseOf(value["base_from_tcp_before"]);
    memory.target.base_from_grasp = poseOf(value["base_from_tcp_grasp"]);
    memory.target.base_from_lift = poseOf(value["base_from_tcp_after"]);
    memory.target.opening = double(value["open_width"]);
    memory.target.part_width = double(value["grip_width"]);
    memory.stamp = double(value["stamp"]);
  } catch (const XmlRpc::XmlRpcException&) {  // not what keep() wrote
    return std::nullopt;
  }

  for (const Rigid3* pose : {&memory.object.base_from_object, &memory.target.base_from_pregrasp,
                             &memory.target.base_from_grasp, &memory.target.base_from_lift})
    if (!pose->isFinite() || !isRotation(pose->rotation)) return std::nullopt;
  return memory;
}

// Not by ros::param::set(): while the master is away that waits for it, with the fingers about to close.
void ParameterMemory::keep(const std::optional<PickMemory>& memory) {
  Value arguments, result, payload;
  arguments[0] = ros::this_node::getName();
  arguments[1] = parameterName();
  if (memory) arguments[2] = toParameter(*memory);
  const bool kept =
      ros::master::execute(memory ? "setParam" : "deleteParam", arguments, result, payload, false);
  if (memory && !kept)
    ROS_WARN("the master does not keep what is picked: a planner that starts again would not know it");
}

std::optional<PickMemory> ParameterMemory::kept() {
  Value value;
  if (!ros::param::get(parameterName(), value)) return std::nullopt;
  return fromParameter(value);
}

}  // namespace monocular_eye_hand
