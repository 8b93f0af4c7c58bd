#pragma once
#include "support/camera.h"

namespace monocular_eye_hand {

/// A camera without a lens, of few pixels: what takes most of the time is rendering.
inline Camera pinhole() { return centredCamera(320, 240, 350); }

}  // namespace monocular_eye_hand
