#include "nodes/common/robot_messages.h"

#include <monocular_eye_hand/MoveResult.h>
#include <monocular_eye_hand/PickResult.h>
#include <monocular_eye_hand/PlaceResult.h>
#include <monocular_eye_hand/RecoverResult.h>

#include <algorithm>
#include <array>

#include "nodes/common/stamps.h"

namespace monocular_eye_hand {
namespace {

/// But for GRASP_LOST, which Move.action does not name.
template <class Result>
constexpr bool hasCodesOfPick() {
  return int(Result::DONE) == PickResult::DONE && int(Result::UNREACHABLE) == PickResult::UNREACHABLE &&
         int(Result::IN_COLLISION) == PickResult::IN_COLLISION &&
         int(Result::CANCELLED) == PickResult::CANCELLED && int(Result::FAULT) == PickResult::FAULT;
}
static_assert(hasCodesOfPick<PlaceResult>() && hasCodesOfPick<MoveResult>() &&
              hasCodesOfPick<RecoverResult>());
static_assert(int(PlaceResult::GRASP_LOST) == PickResult::GRASP_LOST);
static_assert(int(RecoverResult::GRASP_LOST) == PickResult::GRASP_LOST);

/// In the order of ActionOutcome.
constexpr std::array<uint8_t, 6> kOutcomeCodes{PickResult::DONE,         PickResult::UNREACHABLE,
                                               PickResult::IN_COLLISION, PickResult::GRASP_LOST,
                                               PickResult::CANCELLED,    PickResult::FAULT};

}  // namespace

JointSample fromMessage(const sensor_msgs::JointState& message, const ros::Time& now) {
  return {nanoseconds(stampOr(message.header.stamp, now)), message.name, message.position, message.velocity};
}

GripperReading fromMessage(const GripperState& message, const ros::Time& now) {
  GripperReading reading;
  reading.stamp = stampOr(message.header.stamp, now).toSec();
  reading.width = message.width;
  reading.moving = message.moving;
  reading.stalled = message.stalled;
  return reading;
}

uint8_t codeOf(ActionOutcome outcome) { return kOutcomeCodes.at(size_t(outcome)); }

ActionOutcome outcomeOf(uint8_t code) {
  const auto found = std::find(kOutcomeCodes.begin(), kOutcomeCodes.end(), code);
  return found == kOutcomeCodes.end() ? ActionOutcome::kFault : ActionOutcome(found - kOutcomeCodes.begin());
}

}  // namespace monocular_eye_hand
