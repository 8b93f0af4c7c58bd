#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

const char* name(Decision decision) {
  switch (decision) {
    case Decision::kAccepted:
      return "accepted";
    case Decision::kRejected:
      return "rejected";
    case Decision::kAmbiguous:
      return "ambiguous";
  }
  return "unknown";
}

}  // namespace monocular_eye_hand
