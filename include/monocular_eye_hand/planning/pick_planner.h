#pragma once
#include "monocular_eye_hand/planning/pick_plan.h"
#include "monocular_eye_hand/planning/trajectory.h"

namespace monocular_eye_hand {

/// Plans to take the object and put it down: over all configurations, those soonest reached first. The object
/// stands in `world` and nothing is carried. Of what failed, the plan that came furthest gives outcome and
/// reason. Throws BadInput on an unknown object or support, poses or joints that are not finite, joints
/// outside the limits, widths the gripper does not have, no drop, or options out of range.
PickPlan planPick(const ToolArm& arm, const CollisionWorld& world, const PickRequest& request,
                  const PlanningOptions& options = {});

/// The world that planPick() tests its motion of this stage in: with true shapes, what is carried attached,
/// and what may touch allowed. For re-checking a plan. Throws BadInput when nothing is planned.
CollisionWorld worldOf(PickStage stage, const CollisionWorld& world, const PickRequest& request,
                       const PickPlan& plan);

}  // namespace monocular_eye_hand
