#pragma once
#include <string>

#include "monocular_eye_hand/grasp/grasp_plan.h"

namespace monocular_eye_hand {

/// What a pose's uncertainty needs at one grasp.
struct ClearanceNeed {
  double closing = 0;            ///< `sigmas` deviations at the pads' corners, and min_clearance [m]
  double across = 0, along = 0;  ///< `sigmas` deviations along gripper_tcp's x and z [m]
  std::string refusal;           ///< why it does not fit; empty: it does
  double shortfall = 0;          ///< by how much it does not fit [m]
};

/// `held`: covariance of base_from_object without free turns, base axes.
ClearanceNeed clearanceNeed(const Rigid3& base_from_object, const Matrix6d& held, const Rigid3& base_from_tcp,
                            double width, const GripperOptions& gripper, const GraspPlanOptions& options);

}  // namespace monocular_eye_hand
