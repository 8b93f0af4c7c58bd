#pragma once
#include <stdexcept>
#include <string>

namespace monocular_eye_hand {

/// A file, calibration or option that cannot be used. The message names what is wrong, where, and what to do.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace monocular_eye_hand
