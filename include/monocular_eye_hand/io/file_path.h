#pragma once
#include <string>

namespace monocular_eye_hand {

/// The path that a name of a file stands for: plain paths, absolute or from `folder` ("" = the working
/// directory); package://NAME/... and $(find NAME)/... (ROS_PACKAGE_PATH, the install spaces of
/// CMAKE_PREFIX_PATH, then `rospack`); file:///...; ~ and ~USER; $VARIABLE, ${VARIABLE} and $(env VARIABLE).
/// A plain name of an existing file is that file, whatever signs it holds. Throws BadInput naming the
/// package, variable or scheme that is not known and what to do; the file itself need not exist.
std::string resolvedPath(const std::string& name, const std::string& folder = "");

/// The path that a parameter means. Nodes of a launch file run in a folder of ROS; the shell's own one is
/// still in $PWD, so a relative path that is not found here is looked for there. URLs, ~ and $VARIABLE are
/// left as they are, "" too. Throws BadInput naming the parameter and both folders when neither has it.
std::string pathParameter(const std::string& parameter, const std::string& path);

}  // namespace monocular_eye_hand
