#pragma once
#include <vector>

#include "monocular_eye_hand/grasp/grasp_plan.h"

namespace monocular_eye_hand {

/// One arm posture for all three poses of a grasp.
struct Posture {
  Branch branch;
  JointVector pregrasp, grasp, lift;  ///< lift: where it ends
  double travel = 0;                  ///< from `current` to pre-grasp: the joint that turns farthest [rad]
};

struct Postures {
  std::vector<Posture> postures;                      ///< one per branch, shortest travel first
  GraspRefusal refusal = GraspRefusal::kUnreachable;  ///< when there is none
  std::string reason;
};

/// Poses of tool0.
Postures findPostures(const Puma560& arm, const Rigid3& pregrasp, const Rigid3& grasp, const Rigid3& lift,
                      const JointVector& current, const GraspPlanOptions& options);

}  // namespace monocular_eye_hand
