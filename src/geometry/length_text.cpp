#include "monocular_eye_hand/geometry/length_text.h"

#include <fmt/format.h>

namespace monocular_eye_hand {

std::string millimetresText(double metres) { return fmt::format("{:.1f} mm", 1e3 * metres); }

}  // namespace monocular_eye_hand
