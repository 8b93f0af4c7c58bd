#pragma once
#include <vector>

#include "monocular_eye_hand/execution/options.h"
#include "monocular_eye_hand/mesh/mesh.h"
#include "monocular_eye_hand/planning/pick_plan.h"

namespace monocular_eye_hand {

/// The smallest rectangle around what a part covers of the table, seen from above, in the base frame.
struct FootprintBox {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< [m]
  double yaw = 0;                                    ///< of the long side, 0 to pi [rad]
  double length = 0, width = 0;                      ///< length >= width [m]
};
FootprintBox footprintOf(const Mesh& mesh, const Rigid3& base_from_object);

/// Where gripper_tcp lets go so that the part stands at the place as it stood where it was grasped, turned
/// about the vertical only: along the place's yaw, across it, then diagonally; of equal ones the smaller turn
/// first. `gap`: how far above where it stood; `above`: where the straight way down begins [m].
std::vector<DropTarget> dropTargets(const DropPlace& place, const FootprintBox& footprint,
                                    const Rigid3& base_from_grasp, double gap, double above);

}  // namespace monocular_eye_hand
