#include "monocular_eye_hand/parameters/task.h"

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void TaskParameters::check() const {
  if (objects.empty())
    throw BadInput("~objects is not set: the path of the model base, a YAML like config/objects.yaml");
  if (urdf.empty()) throw BadInput("~urdf is not set: the path of the arm's URDF, as urdf/puma560.urdf");
  if (base_frame.empty()) throw BadInput("base_frame must not be empty");
  TaskOptions::check();
  requirePositive("look_timeout", look_timeout);
  requirePositive("answer_timeout", answer_timeout);
  requirePositive("motion_timeout", motion_timeout);
  requirePositive("state_max_age", state_max_age);
}

}  // namespace monocular_eye_hand
