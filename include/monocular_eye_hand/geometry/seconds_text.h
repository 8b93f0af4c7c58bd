#pragma once
#include <string>

namespace monocular_eye_hand {

/// A time for people, "12.300 s": stamps are too large for the digits of a stream.
std::string secondsText(double seconds, int digits = 3);

}  // namespace monocular_eye_hand
