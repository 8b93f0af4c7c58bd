#pragma once
#include <string>

namespace monocular_eye_hand {

inline bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

}  // namespace monocular_eye_hand
