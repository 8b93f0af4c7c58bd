#include "nodes/planner/parameters.h"

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void PlannerParameters::check() const {
  ExecutorOptions::check();
  if (base_frame.empty()) throw BadInput("base_frame is empty");
  requirePositive("diagnostic_period", diagnostic_period);
}

}  // namespace monocular_eye_hand
