#pragma once
#include <string>

namespace monocular_eye_hand {

/// What a known plane that carries the parts says of a pose.
struct SupportEvidence {
  double rests = 0;     ///< how well the part rests on the plane by itself: 0 not at all, 1 fully
  double log_odds = 0;  ///< what that is worth; far below 0 when the pose cannot be
  std::string refused;  ///< why it cannot be: "reaches 9.6 mm below the support plane"; empty when it can
};

}  // namespace monocular_eye_hand
