#include "nodes/common/action_outcome.h"

#include <monocular_eye_hand/MoveResult.h>
#include <monocular_eye_hand/PickResult.h>
#include <monocular_eye_hand/PlaceResult.h>
#include <monocular_eye_hand/RecoverResult.h>

namespace monocular_eye_hand {
namespace {

constexpr bool same(int a, int b, int c, int d) { return a == b && b == c && c == d; }
static_assert(same(PickResult::DONE, PlaceResult::DONE, MoveResult::DONE, RecoverResult::DONE));
static_assert(same(PickResult::UNREACHABLE, PlaceResult::UNREACHABLE, MoveResult::UNREACHABLE,
                   RecoverResult::UNREACHABLE));
static_assert(same(PickResult::IN_COLLISION, PlaceResult::IN_COLLISION, MoveResult::IN_COLLISION,
                   RecoverResult::IN_COLLISION));
static_assert(same(PickResult::CANCELLED, PlaceResult::CANCELLED, MoveResult::CANCELLED,
                   RecoverResult::CANCELLED));
static_assert(same(PickResult::FAULT, PlaceResult::FAULT, MoveResult::FAULT, RecoverResult::FAULT));
// Move.action does not name the lost grasp.
static_assert(same(PickResult::GRASP_LOST, PlaceResult::GRASP_LOST, RecoverResult::GRASP_LOST,
                   PickResult::GRASP_LOST));

}  // namespace

uint8_t codeOf(ActionOutcome outcome) {
  switch (outcome) {
    case ActionOutcome::kDone:
      return PickResult::DONE;
    case ActionOutcome::kUnreachable:
      return PickResult::UNREACHABLE;
    case ActionOutcome::kInCollision:
      return PickResult::IN_COLLISION;
    case ActionOutcome::kGraspLost:
      return PickResult::GRASP_LOST;
    case ActionOutcome::kCancelled:
      return PickResult::CANCELLED;
    case ActionOutcome::kFault:
      break;
  }
  return PickResult::FAULT;
}

ActionOutcome outcomeOf(uint8_t code) {
  switch (code) {
    case PickResult::DONE:
      return ActionOutcome::kDone;
    case PickResult::UNREACHABLE:
      return ActionOutcome::kUnreachable;
    case PickResult::IN_COLLISION:
      return ActionOutcome::kInCollision;
    case PickResult::GRASP_LOST:
      return ActionOutcome::kGraspLost;
    case PickResult::CANCELLED:
      return ActionOutcome::kCancelled;
    default:
      return ActionOutcome::kFault;
  }
}

}  // namespace monocular_eye_hand
