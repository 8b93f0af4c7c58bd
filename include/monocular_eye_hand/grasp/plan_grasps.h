#pragma once
#include <vector>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/grasp/grasp_plan.h"
#include "monocular_eye_hand/grasp/model_grasps.h"

namespace monocular_eye_hand {

/// Every grasp of the model, its symmetric copies and its half turn, as pre-grasp, grasp and lift that the
/// arm reaches in one configuration without meeting table, part or obstacles. Best first: quality of the
/// model's grasp, steepness of the approach, room for the pose's uncertainty, closing along the table, then
/// the shortest way of the joints from `current`.
///
/// "Fits" means: on each side of the part the gripper's opening leaves `sigmas` standard deviations of the
/// part's place at the pads' corners along the closing direction and min_clearance; across it `sigmas`
/// deviations shift the pads by less than half their size and bring no part of the hand in contact.
/// Deterministic. Throws BadInput on broken poses, covariances or options, not for "no grasp".
GraspPlan planGrasps(const GraspObject& object, const ModelGrasps& grasps, const GraspScene& scene,
                     const GripperOptions& gripper, const Puma560& arm, const Rigid3& tool0_from_tcp,
                     const JointVector& current, const GraspPlanOptions& options = {});

/// The first candidate, then always the next that differs from all taken so far by 15 mm, 0.3 rad or the
/// arm's configuration; when there is none left, the others in their order. At most `count`. For whoever
/// tries one after the other: what is in the way of one is in the way of its neighbours.
std::vector<GraspCandidate> variedFirst(const std::vector<GraspCandidate>& candidates, int count);

}  // namespace monocular_eye_hand
