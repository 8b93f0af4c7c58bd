#pragma once
#include <optional>

#include "calibration/view.h"
#include "monocular_eye_hand/geometry/camera.h"

namespace monocular_eye_hand {

/// camera_from_target of one view alone: the perspective tetrahedron of three far points, refined on all.
/// Nothing when fewer than four points are seen, or they lie on a line.
std::optional<Rigid3> targetPose(const CalibrationView& view, const Camera& camera);

}  // namespace monocular_eye_hand
