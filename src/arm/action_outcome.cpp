#include "monocular_eye_hand/arm/action_outcome.h"

namespace monocular_eye_hand {

std::string toString(ActionOutcome outcome) {
  switch (outcome) {
    case ActionOutcome::kDone:
      return "done";
    case ActionOutcome::kUnreachable:
      return "unreachable";
    case ActionOutcome::kInCollision:
      return "in collision";
    case ActionOutcome::kGraspLost:
      return "grasp lost";
    case ActionOutcome::kCancelled:
      return "cancelled";
    case ActionOutcome::kFault:
      return "fault";
  }
  return "unknown";
}

}  // namespace monocular_eye_hand
