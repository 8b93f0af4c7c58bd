#pragma once
#include <string>

namespace monocular_eye_hand {

/// A number for people: about three digits, never an exponent ("140000", "80", "0.08", "0.00008").
std::string plainNumber(double value);

}  // namespace monocular_eye_hand
