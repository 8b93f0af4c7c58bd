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

const char* name(Fate fate) {
  switch (fate) {
    case Fate::kAccepted:
      return "accepted";
    case Fate::kAmbiguous:
      return "ambiguous";
    case Fate::kRejected:
      return "rejected";
    case Fate::kSuppressed:
      return "suppressed";
  }
  return "unknown";
}

}  // namespace monocular_eye_hand
