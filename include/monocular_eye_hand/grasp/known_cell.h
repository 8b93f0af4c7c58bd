#pragma once
#include <optional>

#include "monocular_eye_hand/arm/gripper_reading.h"
#include "monocular_eye_hand/eye_hand/known_space.h"
#include "monocular_eye_hand/grasp/grasping_options.h"

namespace monocular_eye_hand {

/// What is filled when a view is taken, in the arm's base: below the table, the boxes of the cell, the hand,
/// and what it holds. `table_height`: z of the table's top in base [m]. Without `gripper` nobody knows where
/// the fingers are: only the hand's body counts.
KnownSpace knownCell(const GraspingOptions& options, double table_height, const Rigid3& base_from_tcp,
                     const std::optional<GripperReading>& gripper);

}  // namespace monocular_eye_hand
