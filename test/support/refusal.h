#pragma once
#include <string>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

/// What a call that takes its input returns.
inline const char* const kAccepted = "accepted";

/// The text of the BadInput that `call` throws, or kAccepted.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const BadInput& e) {
    return e.what();
  }
  return kAccepted;
}

}  // namespace monocular_eye_hand
