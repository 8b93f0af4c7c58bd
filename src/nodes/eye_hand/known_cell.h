#pragma once
#include <optional>

#include "monocular_eye_hand/arm/gripper_reading.h"
#include "monocular_eye_hand/eye_hand/object_view.h"
#include "nodes/eye_hand/parameters.h"

namespace monocular_eye_hand {

/// What is filled when a view is taken, in the arm's base: below the table, the boxes of the cell, the hand,
/// and what it holds. `table_height`: z of the table's top in base [m]. Without `gripper` nobody knows where
/// the fingers are: only the hand's body counts.
KnownSpace knownCell(const EyeHandParameters& parameters, double table_height, const Rigid3& base_from_tcp,
                     const std::optional<GripperReading>& gripper);

/// Whether the gripper holds something, of whatever shape.
bool holds(const std::optional<GripperReading>& gripper, double held_width);

/// What the objects of a view say of the axes of its frame.
enum class FrameAxes {
  kUnknown,
  kOptical,  ///< one of them stands on the table
  kBody      ///< none does, and all would if the frame were the camera's body (x forward)
};
/// `view`: with hand, hand-eye and objects.
FrameAxes axesOf(const ObjectView& view, const ModelBase& models, double table_height);

}  // namespace monocular_eye_hand
