#pragma once
#include <string>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/model/known_object.h"
#include "nodes/eye_hand/parameters.h"

namespace monocular_eye_hand {

/// The models of a model base with what a robot may do with them, without the views that recognition needs.
/// Throws BadInput as loadModelBase.
ModelBase loadShapes(const std::string& yaml_path);

/// The arm of the parameter `urdf`. Throws BadInput when it is not the arm of the parameter `arm`, or its
/// gripper opens less than the parameter `gripper` says.
ArmDescription loadSameArm(const EyeHandParameters& parameters, const Puma560& arm);

/// Logs a warning when /robot_description is not what the file says.
void warnOfOtherRobot(const std::string& urdf_path);

}  // namespace monocular_eye_hand
