#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/action_outcome.h"
#include "monocular_eye_hand/planning/trajectory.h"

namespace monocular_eye_hand {

/// One way to take hold of an object.
struct PickTarget {
  std::string object;                                          ///< a world object
  Rigid3 base_from_pregrasp, base_from_grasp, base_from_lift;  ///< lift: where it ends
  double opening = 0, part_width = 0;  ///< between the finger pads, before and after closing [m]
};

/// Where gripper_tcp lets go; it comes from `above` in a straight line and withdraws as far against its own
/// z, or, where that is blocked, the way it came.
struct DropTarget {
  Rigid3 base_from_tcp_above, base_from_tcp;
};

struct PickRequest {
  JointVector start = JointVector::Zero();
  PickTarget target;
  std::vector<DropTarget> drops;  ///< the first that works is taken
  std::vector<std::string>
      supports;  ///< world objects that the carried one may touch while lifted and lowered
};

enum class PickOutcome {
  kPlanned,
  kStartInCollision,
  kGraspUnreachable,  ///< pre-grasp, grasp or lift: out of reach, limits, singularity
  kGraspInCollision,  ///< the arm cannot be at the pre-grasp
  kApproachBlocked,
  kLiftBlocked,
  kNoPathToGrasp,
  kDropUnreachable,
  kDropInCollision,
  kLoweringBlocked,
  kNoPathToDrop,
};
/// "approach blocked" and so on, for messages.
std::string toString(PickOutcome outcome);
ActionOutcome outcomeOf(PickOutcome outcome);

enum class PickStage { kReach, kApproach, kLift, kCarry, kLower, kRetreat };
std::string toString(PickStage stage);

/// One motion. The gripper closes before kLift and opens before kRetreat.
struct PickMotion {
  PickStage stage = PickStage::kReach;
  Trajectory trajectory;
  double gripper_width = 0;  ///< while it moves [m]
};

struct PickPlan {
  PickOutcome outcome = PickOutcome::kPlanned;
  std::string reason;               ///< what stands in the way, by name; empty when planned
  std::vector<PickMotion> motions;  ///< all six, each beginning where the last one ended
  ArmConfiguration configuration;   ///< configuration at the grasp
  int drop = -1;                    ///< PickRequest::drops
  bool planned() const { return outcome == PickOutcome::kPlanned; }
  /// Throws BadInput when the plan has none of this stage.
  const PickMotion& motion(PickStage stage) const;
  std::vector<Trajectory> trajectories() const;  ///< of the motions
  double duration() const;                       ///< of the motions [s]
};

}  // namespace monocular_eye_hand
