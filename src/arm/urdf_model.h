#pragma once
#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <string>

#include "monocular_eye_hand/arm/arm_description.h"

namespace monocular_eye_hand {

/// Reads and parses the file. Throws BadInput with urdfdom's own complaints, which then do not reach the
/// console.
urdf::ModelInterfaceSharedPtr readUrdf(const std::string& path);

Rigid3 toRigid(const urdf::Pose& pose);

/// The shapes of a link. Meshes are found as loadArmDescription() says. Throws BadInput on a sphere, on a
/// size that is not above 0, and on a mesh that cannot be read.
void readShapes(const urdf::Link& link, const std::string& urdf_path, ArmLink* out);

}  // namespace monocular_eye_hand
