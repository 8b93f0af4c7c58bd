#include <fmt/format.h>

#include "monocular_eye_hand/geometry/require.h"
#include "monocular_eye_hand/task/clear_frame.h"

namespace monocular_eye_hand {
namespace {

void requireAtLeast(const char* field, double value, double min_value) {
  require(value >= min_value, field, value, fmt::format("{:g} or more", min_value));
}

}  // namespace

void ClearFrameOptions::check() const {
  requireAtLeast("frame_margin", frame_margin, 0);
  requireAtLeast("overviews", overviews, 1);
  requireAtLeast("overviews_again", overviews_again, 1);
  requireAtLeast("doubtful_misses", doubtful_misses, 1);
  requireAtLeast("confirm_views", confirm_views, 1);
  requireShare("confirm_probability", confirm_probability);
  requireAtLeast("retry_wait", retry_wait, 0);
  requireAtLeast("doubtful_looks", doubtful_looks, 1);
  requireAtLeast("look_attempts", look_attempts, 1);
  requireAtLeast("near_looks", near_looks, 1);
  requireAtLeast("searches", searches, 0);
  requireAtLeast("confirm_attempts", confirm_attempts, 1);
  requireAtLeast("blocked_rounds", blocked_rounds, 1);
  requireAtLeast("pick_attempts", pick_attempts, 1);
  requireAtLeast("candidates", candidates, 1);
  requireAtLeast("max_rounds", max_rounds, 1);
}

std::string toString(TaskStage stage) {
  switch (stage) {
    case TaskStage::kLook:
      return "look";
    case TaskStage::kChoose:
      return "choose";
    case TaskStage::kConfirm:
      return "confirm";
    case TaskStage::kPick:
      return "pick";
    case TaskStage::kVerify:
      return "verify";
    case TaskStage::kCarry:
      return "carry";
    case TaskStage::kDone:
      return "done";
  }
  return "unknown";
}

std::string toString(TaskOutcome outcome) {
  switch (outcome) {
    case TaskOutcome::kCleared:
      return "cleared";
    case TaskOutcome::kLeftovers:
      return "leftovers";
    case TaskOutcome::kNoFrame:
      return "no frame";
    case TaskOutcome::kCancelled:
      return "cancelled";
    case TaskOutcome::kFault:
      return "fault";
  }
  return "unknown";
}

std::string toString(ObjectOutcome outcome) {
  switch (outcome) {
    case ObjectOutcome::kWaiting:
      return "waiting";
    case ObjectOutcome::kCarried:
      return "carried";
    case ObjectOutcome::kGone:
      return "gone";
    case ObjectOutcome::kLeft:
      return "left";
    case ObjectOutcome::kHeld:
      return "held";
    case ObjectOutcome::kDropped:
      return "dropped";
    case ObjectOutcome::kDoubt:
      return "doubt";
  }
  return "unknown";
}

}  // namespace monocular_eye_hand
