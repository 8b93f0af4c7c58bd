#pragma once
#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {

/// The probability of these log-odds.
inline double logistic(double log_odds) { return 1 / (1 + std::exp(-std::clamp(log_odds, -50.0, 50.0))); }

}  // namespace monocular_eye_hand
