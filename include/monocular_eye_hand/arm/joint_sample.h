#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/nanoseconds.h"

namespace monocular_eye_hand {

/// What a driver tells of joints at one moment: any joints, in any order, of one device or of several.
struct JointSample {
  Nanoseconds stamp = 0;  ///< of the clock
  std::vector<std::string> names;
  std::vector<double> positions;  ///< one per name [rad]; a broken driver tells fewer
  std::vector<double> speeds;     ///< one per name [rad/s], or none
};

}  // namespace monocular_eye_hand
