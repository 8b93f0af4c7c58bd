#pragma once
#include <string>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/arm/puma560.h"

namespace monocular_eye_hand {

/// Reads a URDF (urdfdom) whose root is base_link; with the links tool0, gripper_tcp and
/// camera_optical_frame, all three fixed to each other; revolute joints joint1 to joint6 from base_link to
/// tool0, and two prismatic finger joints along y of gripper_tcp, one of which mimics the other and whose
/// value 0 is the closed gripper. Mesh paths are package://<package>/<path>, looked for in the URDF's folder
/// and those above it, or relative to its folder. Throws BadInput naming the file and what is missing or
/// wrong.
ArmDescription loadArmDescription(const std::string& urdf_path);

/// Throws BadInput when tool0 of the description and of the kinematics are not at the same place (1e-6 m and
/// rad) at some joint angles: lengths were changed in one of the two only.
void requireSameArm(const ArmDescription& description, const Puma560& arm);

}  // namespace monocular_eye_hand
