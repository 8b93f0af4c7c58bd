#pragma once
#include <vector>

#include "monocular_eye_hand/grasp/grasp_plan.h"

namespace monocular_eye_hand {

/// One arm configuration for all three poses of a grasp.
struct GraspConfiguration {
  ArmConfiguration configuration;
  JointVector pregrasp, grasp, lift;  ///< lift: where it ends
  double travel = 0;                  ///< from `current` to pre-grasp: the joint that turns farthest [rad]
};

struct GraspConfigurations {
  std::vector<GraspConfiguration> configurations;     ///< each once, shortest travel first
  GraspRefusal refusal = GraspRefusal::kUnreachable;  ///< when there is none
  std::string reason;
};

/// Poses of tool0.
GraspConfigurations findConfigurations(const Puma560& arm, const Rigid3& pregrasp, const Rigid3& grasp,
                                       const Rigid3& lift, const JointVector& current,
                                       const GraspPlanOptions& options);

}  // namespace monocular_eye_hand
