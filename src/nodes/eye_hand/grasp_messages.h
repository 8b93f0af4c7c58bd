#pragma once
#include <monocular_eye_hand/GraspTargetArray.h>
#include <monocular_eye_hand/GraspTargets.h>

#include <string>
#include <vector>

#include "monocular_eye_hand/grasp/grasp_advisor.h"
#include "nodes/eye_hand/shared_map.h"

namespace monocular_eye_hand {

/// The reply of ~grasp_targets. `known`: what the answer was found in.
GraspTargets::Response toMessage(const GraspAnswer& answer, const KnownObjects& known);
/// The message of ~best_grasps.
GraspTargetArray toMessage(const std::vector<BestGrasp>& best, const KnownObjects& known,
                           const std::string& base_frame);

}  // namespace monocular_eye_hand
