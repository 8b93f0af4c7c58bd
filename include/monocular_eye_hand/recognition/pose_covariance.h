#pragma once
#include <vector>

#include "monocular_eye_hand/pose/refine.h"

namespace monocular_eye_hand {

/// Covariance of a pose aligned to contour samples whose errors are not independent: what displaces an edge
/// in the image (a chamfer, a shadow, blur, the model's tolerance) displaces all of it. Every feature (group)
/// has one common error beside the independent ones, and the covariance is the sandwich H^-1 (sum_i w_i^2 J_i
/// J_i^T s_i^2 + sum_g (sum_{i in g} w_i J_i) (...)^T s_g^2) H^-1. Order and axes as perturbed(). About a
/// free axis the variance is pi^2 / 3.
Matrix6d contourCovariance(const Rigid3& camera_from_object, const Camera& camera,
                           const std::vector<LineMatch>& matches, const std::vector<int>& groups,
                           const FreeAxis& axis);

}  // namespace monocular_eye_hand
