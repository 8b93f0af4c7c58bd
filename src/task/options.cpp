#include "monocular_eye_hand/task/options.h"

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void TaskOptions::check() const {
  for (double value : centre)
    if (!std::isfinite(value)) throw BadInput("centre must be three finite numbers");
  require(settle >= 0, "settle", settle, "at least 0");
  requirePositive("holding_width", holding_width);
}

}  // namespace monocular_eye_hand
