#pragma once
#include <chrono>

namespace monocular_eye_hand {

/// Of the machine, from some moment on [s].
inline double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace monocular_eye_hand
