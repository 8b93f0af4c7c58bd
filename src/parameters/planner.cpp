#include "monocular_eye_hand/parameters/planner.h"

#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void PlannerParameters::check() const {
  ExecutorOptions::check();
  requireGiven("base_frame", base_frame, "the frame of the arm's base");
  requirePositive("diagnostic_period", diagnostic_period);
}

}  // namespace monocular_eye_hand
