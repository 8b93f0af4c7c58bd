#pragma once
#include "monocular_eye_hand/grasp/gripper.h"
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// How two closed pads touch a part.
struct PadContact {
  double share = 0;      ///< of the pads' area that touches on both sides
  double alignment = 0;  ///< mean cosine between the faces' normals and the closing direction there
};

/// Samples the pads by rays along the closing direction: a place touches when on both sides the part's first
/// face lies within the pad's compliance of `width` / 2 and faces the pad within the friction cone. Needs
/// model.rays.
PadContact padContact(const ObjectModel& model, const GripperOptions& gripper, const Rigid3& object_from_tcp,
                      double width);

}  // namespace monocular_eye_hand
