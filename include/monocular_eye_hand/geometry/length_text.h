#pragma once
#include <string>

namespace monocular_eye_hand {

/// "12.3 mm".
std::string millimetresText(double metres);

}  // namespace monocular_eye_hand
