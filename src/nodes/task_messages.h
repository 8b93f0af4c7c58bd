#pragma once
#include <monocular_eye_hand/ClearFrameFeedback.h>
#include <monocular_eye_hand/ClearFrameResult.h>
#include <monocular_eye_hand/GraspTarget.h>
#include <monocular_eye_hand/LocatedObject.h>

#include "monocular_eye_hand/task/clear_frame.h"

namespace monocular_eye_hand {

/// Throws BadInput on a name that is not in the model base and on a pose that is none.
MappedObject fromMessage(const LocatedObject& message, const ModelBase& models);
/// What the task needs to choose by; the message itself goes on to the planner.
GraspCandidate fromMessage(const GraspTarget& message);
ClearFrameResult toMessage(const TaskResult& result, const std::string& base_frame, double duration);
ClearFrameFeedback toMessage(const TaskFeedback& feedback);

}  // namespace monocular_eye_hand
