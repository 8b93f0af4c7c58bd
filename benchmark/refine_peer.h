#pragma once
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/pose/matches.h"

namespace monocular_eye_hand {

/// Least squares on the reprojection errors by Ceres: angle-axis and translation as one block of parameters,
/// all points in one residual block with analytic Jacobian, DENSE_NORMAL_CHOLESKY, at most 20 iterations,
/// else its defaults. The time of building the problem is part of it, as a caller pays for it with every
/// pose.
Rigid3 refineByCeres(const Rigid3& start, const Camera& camera, const std::vector<PointMatch>& points);

}  // namespace monocular_eye_hand
