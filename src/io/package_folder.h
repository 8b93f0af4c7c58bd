#pragma once
#include <string>

namespace monocular_eye_hand {

/// The folder of a ROS package, without linking ROS. Throws BadInput naming the package and where it was
/// looked for.
std::string packageFolder(const std::string& package);

}  // namespace monocular_eye_hand
