#pragma once
#include <string>

namespace monocular_eye_hand {

/// The way from the camera to the views that a task waits for, as far as the task can see it. Names are those
/// of the lines that the parts speak by.
struct EyeChain {
  std::string recognizer_call;      ///< by which the recogniser is asked
  std::string recognized, located;  ///< what the recogniser, and what eye-hand tells
  bool recognizer_gone = false;     ///< it cannot be asked, and is silent for as long
  bool tells_recognized = false;    ///< somebody is there who would
  bool tells_located = false;       ///< somebody is there who would
  double last_recognized = 0;       ///< stamp of the last image that was worked on [s]; 0: none
  std::string complaint;            ///< why the recogniser could not work; "": it could
};

/// Who in the chain is why no view of an image from `after` [s] on came within `timeout` [s], and what to do.
std::string missingInput(const EyeChain& chain, double after, double timeout);

}  // namespace monocular_eye_hand
