#include <gtest/gtest.h>

#include "nodes/common/action_outcome.h"

namespace monocular_eye_hand {
namespace {

TEST(ActionOutcome, ComesBackFromItsCode) {
  for (const ActionOutcome outcome :
       {ActionOutcome::kDone, ActionOutcome::kUnreachable, ActionOutcome::kInCollision,
        ActionOutcome::kGraspLost, ActionOutcome::kCancelled, ActionOutcome::kFault})
    EXPECT_EQ(outcomeOf(codeOf(outcome)), outcome) << toString(outcome);
}

TEST(ActionOutcome, OfAnUnknownCodeIsAFault) { EXPECT_EQ(outcomeOf(77), ActionOutcome::kFault); }

}  // namespace
}  // namespace monocular_eye_hand
