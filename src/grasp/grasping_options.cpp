#include "monocular_eye_hand/grasp/grasping_options.h"

#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void GraspingOptions::check() const {
  requireOwnNames(boxes);
  require(held_width >= 0, "held_width", held_width, "0 or more");
}

}  // namespace monocular_eye_hand
