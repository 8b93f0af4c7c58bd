#pragma once
#include <Eigen/Core>

#include "features/linking.h"
#include "monocular_eye_hand/geometry/camera.h"

namespace monocular_eye_hand {

/// Moves linked edges from raw to rectified pixels, normals and standard deviations with them. Neighbouring
/// points start Newton's method from each other, so one step per point is enough. Points outside the region
/// where the distortion is one-to-one are dropped, their trace broken there.
void undistortEdges(const LinkedEdges& raw, const Camera& camera, int min_trace_points, LinkedEdges* out);

}  // namespace monocular_eye_hand
