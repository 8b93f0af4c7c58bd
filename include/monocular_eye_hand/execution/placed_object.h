#pragma once
#include <string>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// A known object and where it stands.
struct PlacedObject {
  std::string name;  ///< in the model base
  int instance = 0;
  Rigid3 base_from_object;

  std::string label() const { return name + " " + std::to_string(instance); }  ///< its name in the world
};

}  // namespace monocular_eye_hand
