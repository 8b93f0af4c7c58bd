#pragma once
#include <string>

namespace monocular_eye_hand {

/// The path that a name of a file stands for: plain paths, absolute or from `folder` ("" = the working
/// directory); package://NAME/... and $(find NAME)/... (ROS_PACKAGE_PATH, the install spaces of
/// CMAKE_PREFIX_PATH, then `rospack`); file:///...; ~ and ~USER; $VARIABLE, ${VARIABLE} and $(env VARIABLE).
/// A plain name of an existing file is that file, whatever signs it holds. Throws BadInput naming the
/// package, variable or scheme that is not known and what to do; the file itself need not exist.
std::string resolvedPath(const std::string& name, const std::string& folder = "");

}  // namespace monocular_eye_hand
