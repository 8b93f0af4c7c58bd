#pragma once
#include <string>

namespace monocular_eye_hand {

/// The folder with config/, models/ and urdf/ of the package that this program belongs to: where it is
/// installed, else the sources that it was built from. Throws BadInput when neither is there.
std::string packageFolder();

}  // namespace monocular_eye_hand
