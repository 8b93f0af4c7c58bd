#pragma once
#include "monocular_eye_hand/eye_hand/object_view.h"
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

/// What the objects of a view say of the axes of its frame.
enum class FrameAxes {
  kUnknown,
  kOptical,  ///< one of them stands on the table
  kBody      ///< none does, and all would if the frame were the camera's body (x forward)
};
/// `view`: with hand, hand-eye and objects. `table_height`: z of the table's top in base [m].
FrameAxes axesOf(const ObjectView& view, const ModelBase& models, double table_height);

}  // namespace monocular_eye_hand
