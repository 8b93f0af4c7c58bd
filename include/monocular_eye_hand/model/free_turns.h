#pragma once
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// What is left of a pose covariance when the rotations that the symmetry makes meaningless (about the axis,
/// about the centre of a sphere) are held at zero: the covariance given those angles. Without such a freedom
/// it is `covariance` itself. Order and axes as perturbed().
Matrix6d conditionedOnFreeAxis(const ObjectModel& model, const Rigid3& a_from_object,
                               const Matrix6d& covariance);

/// The covariance of a held pose with the free rotations put back, each with the variance pi^2 / 3 of a
/// uniform angle.
Matrix6d withFreeAxisVariance(const ObjectModel& model, const Rigid3& a_from_object, const Matrix6d& held);

}  // namespace monocular_eye_hand
