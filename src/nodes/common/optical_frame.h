#pragma once
#include <tf2/buffer_core.h>

#include <string>

namespace monocular_eye_hand {

/// A frame of tf that hangs in `frame` as an optical frame hangs in its camera's body; "" when there is none.
std::string opticalFrameIn(const tf2::BufferCore& tf, const std::string& frame);

}  // namespace monocular_eye_hand
