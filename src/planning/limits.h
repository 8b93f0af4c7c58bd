#pragma once

namespace monocular_eye_hand {

/// Searches of one plan that may use up their share of its budget.
inline constexpr int kFailedSearches = 4;

/// Near parts the corner between two straight lines is rounded no farther than this, so that they stay
/// straight [rad].
inline constexpr double kNearCorner = 0.002;

}  // namespace monocular_eye_hand
