#pragma once
#include <cstdint>

#include "monocular_eye_hand/arm/action_outcome.h"

namespace monocular_eye_hand {

/// The number of an outcome in the results of Pick, Place, Move and Recover, which is the same in all four.
uint8_t codeOf(ActionOutcome outcome);
/// A number that none of them has is a fault.
ActionOutcome outcomeOf(uint8_t code);

}  // namespace monocular_eye_hand
