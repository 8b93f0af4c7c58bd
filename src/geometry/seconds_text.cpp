#include "monocular_eye_hand/geometry/seconds_text.h"

#include <cstdio>

namespace monocular_eye_hand {

std::string secondsText(double seconds, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f s", digits, seconds);
  return text;
}

}  // namespace monocular_eye_hand
