#pragma once
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// Factor on the albedo at point `p` with unit normal `n` (object frame): 1 +- amplitude.
double textureFactor(const Texture& texture, const Eigen::Vector3d& p, const Eigen::Vector3d& n);

}  // namespace monocular_eye_hand
