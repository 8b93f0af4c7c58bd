#pragma once
#include <algorithm>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// The larger of the rotations' and the translations' difference, the latter relative to the distance.
inline double relativeError(const Rigid3& pose, const Rigid3& truth) {
  return std::max((pose.rotation - truth.rotation).norm(),
                  (pose.translation - truth.translation).norm() / truth.translation.norm());
}

}  // namespace monocular_eye_hand
