#pragma once
#include <string>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

/// What a call says is wrong.
template <class Function>
std::string failure(const Function& function) {
  try {
    function();
  } catch (const BadInput& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace monocular_eye_hand
