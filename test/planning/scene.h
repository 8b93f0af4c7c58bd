#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/planning/pick_planner.h"

namespace monocular_eye_hand {

inline std::string sourceFile(const std::string& path) {
  return std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/" + path;
}
inline const ArmDescription& armDescription() {
  static const ArmDescription arm = loadArmDescription(sourceFile("urdf/puma560.urdf"));
  return arm;
}
inline ToolArm toolArm() { return {Puma560(), armDescription().tool0_from_tcp}; }
inline Mesh shippedMesh(const std::string& name) {
  return loadMesh(sourceFile("models/" + name + ".ply"), "mm");
}

inline Rigid3 at(double x, double y, double z, double yaw = 0) {
  Rigid3 pose;
  pose.rotation = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation = {x, y, z};
  return pose;
}
/// gripper_tcp looking down; `yaw` of the line from pad to pad from base y.
inline Rigid3 down(double x, double y, double z, double yaw = 0) {
  Rigid3 pose = at(x, y, z, yaw);
  pose.rotation = pose.rotation * Eigen::Vector3d(1, -1, -1).asDiagonal();
  return pose;
}

constexpr double kTableTop = 0.30;

/// The arm up and bent, looking at the table.
inline JointVector lookingJoints() {
  ArmSolutions solutions;
  toolArm().inverse(down(0.45, 0.0, 0.62), JointVector::Zero(), &solutions);
  for (const ArmSolution& s : solutions)
    if (s.configuration == ArmConfiguration{Shoulder::kRight, Elbow::kUp, Wrist::kPositive}) return s.joints;
  return solutions[0].joints;
}

/// Table, frame, two bridges and a grenade in it.
inline CollisionWorld demoWorld() {
  CollisionWorld world(armDescription());
  world.addBox("table", {0.70, 1.50, 0.04}, at(0.60, -0.15, kTableTop - 0.02));
  world.addMesh("frame", shippedMesh("frame"), at(0.55, 0, kTableTop));
  world.addMesh("bridge_0", shippedMesh("bridge"), at(0.50, 0.045, kTableTop + 1e-4));
  world.addMesh("bridge_1", shippedMesh("bridge"), at(0.505, -0.045, kTableTop + 1e-4, 0.1));
  world.addMesh("grenade", shippedMesh("grenade"), at(0.62, 0.0, kTableTop + 1e-4));
  return world;
}

/// A grasp from above at the height of the pads, carried to the drop zone beside the frame.
inline PickRequest pickRequest(const std::string& object, double x, double y, double z, double yaw,
                               double width) {
  PickRequest request;
  request.start = lookingJoints();
  request.target.object = object;
  request.target.base_from_grasp = down(x, y, z, yaw);
  request.target.base_from_pregrasp = down(x, y, z + 0.08, yaw);
  request.target.base_from_lift = down(x, y, z + 0.10, yaw);
  request.target.opening = std::min(0.09, width + 0.02);
  request.target.part_width = width;
  for (double drop_yaw : {0.0, M_PI / 2, -M_PI / 2})
    request.drops.push_back({down(0.50, -0.48, z + 0.10, drop_yaw), down(0.50, -0.48, z + 2e-3, drop_yaw)});
  request.supports = {"table"};
  return request;
}
inline PickRequest bridgeRequest() {
  return pickRequest("bridge_0", 0.50, 0.045, kTableTop + 0.048, 0, 0.040);
}

}  // namespace monocular_eye_hand
