#include "nodes/task/parameters.h"

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

void TaskParameters::check() const {
  if (objects.empty())
    throw BadInput("~objects is not set: the path of the model base, a YAML like config/objects.yaml");
  if (urdf.empty()) throw BadInput("~urdf is not set: the path of the arm's URDF, as urdf/puma560.urdf");
  if (base_frame.empty()) throw BadInput("base_frame must not be empty");
  for (double value : centre)
    if (!std::isfinite(value)) throw BadInput("centre must be three finite numbers");
  const auto positive = [](const char* field, double value) {
    if (!(value > 0))
      throw BadInput(std::string(field) + " = " + std::to_string(value) + " must be positive");
  };
  if (!(settle >= 0)) throw BadInput("settle = " + std::to_string(settle) + " must be at least 0");
  positive("look_timeout", look_timeout);
  positive("answer_timeout", answer_timeout);
  positive("motion_timeout", motion_timeout);
  positive("holding_width", holding_width);
  positive("state_max_age", state_max_age);
}

}  // namespace monocular_eye_hand
