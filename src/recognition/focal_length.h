#pragma once
#include <cmath>

#include "monocular_eye_hand/geometry/camera.h"

namespace monocular_eye_hand {

/// What turns angles into pixels, whichever way they lie: the geometric mean of fx and fy [px].
inline double focalLength(const Camera& camera) { return std::sqrt(camera.fx * camera.fy); }

}  // namespace monocular_eye_hand
