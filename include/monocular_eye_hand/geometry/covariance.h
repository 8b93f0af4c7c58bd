#pragma once
#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

// 6x6 covariances of poses: order x, y, z, rotation about x, y, z, fixed axes of the target frame, rotation
// about the moved frame's origin (see perturbed()). First order in the rotations.

/// How a small motion d of a_from_b moves a_from_c = a_from_b * b_from_c: d' = A d.
/// `offset`: from b's origin to c's, in a's axes: a_from_b.rotation * b_from_c.translation.
Matrix6d adjointOfTranslation(const Eigen::Vector3d& offset);

/// The same small motion in axes rotated by `rotation` (a_from_b: from b's axes to a's): d' = A d.
Matrix6d adjointOfRotation(const Eigen::Matrix3d& rotation);

/// The covariance of A d, A C A^T, symmetric to the last bit.
Matrix6d propagate(const Matrix6d& jacobian, const Matrix6d& covariance);

/// Throws BadInput, its message beginning with `what`, when the matrix is not finite, not symmetric (1e-6 of
/// its largest entry) or has, scaled to a unit diagonal, an eigenvalue below -1e-6 of its largest.
void requireCovariance(const Matrix6d& covariance, const char* what);

}  // namespace monocular_eye_hand
