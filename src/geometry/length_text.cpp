#include "monocular_eye_hand/geometry/length_text.h"

#include <cstdio>

namespace monocular_eye_hand {

std::string millimetresText(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f mm", 1e3 * metres);
  return text;
}

}  // namespace monocular_eye_hand
