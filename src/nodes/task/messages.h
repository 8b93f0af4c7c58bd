#pragma once
#include <monocular_eye_hand/ClearFrameFeedback.h>
#include <monocular_eye_hand/ClearFrameResult.h>
#include <monocular_eye_hand/GraspTarget.h>
#include <monocular_eye_hand/GraspTargetsResponse.h>
#include <monocular_eye_hand/LocatedObject.h>

#include <string>

#include "monocular_eye_hand/task/clear_frame.h"

namespace monocular_eye_hand {

/// Throws BadInput on a name that is not in the model base and on an invalid pose.
MappedObject fromMessage(const LocatedObject& message, const ModelBase& models);
/// Throws BadInput on an invalid pose and on a branch that the arm has not. The message does not tell
/// GraspCandidate::model_grasp.
GraspCandidate fromMessage(const GraspTarget& message);
/// The answer to a question for the grasps of `asked`: its object is `asked`, but where eye_hand planned for
/// it. Throws BadInput as above, and when a grasp is of another object, in another frame than `base_frame` or
/// was planned for another pose than the first.
TaskGrasps fromMessage(const GraspTargetsResponse& response, const MappedObject& asked,
                       const std::string& base_frame);
/// What the planner is asked to pick. base_frame: of all poses.
GraspTarget toMessage(const PlannedGrasp& planned, const std::string& base_frame);
ClearFrameResult toMessage(const TaskResult& result, const std::string& base_frame, double duration);
ClearFrameFeedback toMessage(const TaskFeedback& feedback);

}  // namespace monocular_eye_hand
