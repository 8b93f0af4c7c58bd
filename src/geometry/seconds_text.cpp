#include "monocular_eye_hand/geometry/seconds_text.h"

#include <fmt/format.h>

namespace monocular_eye_hand {

std::string secondsText(double seconds, int digits) { return fmt::format("{:.{}f} s", seconds, digits); }

}  // namespace monocular_eye_hand
