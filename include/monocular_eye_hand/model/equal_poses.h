#pragma once
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// Rotation about a point that need not be the origin: object_from_object.
Rigid3 rotationAbout(const Eigen::Vector3d& point, const Eigen::Matrix3d& rotation);
/// Rotation about a line that need not pass through the origin: object_from_object.
Rigid3 rotationAbout(const SymmetryAxis& axis, double angle);

/// `pose` turned about the model's free axis (or a sphere's centre) so that its rotation is nearest to that
/// of `wanted`; without such a freedom `pose` itself.
Rigid3 turnedTowards(const ObjectModel& model, const Rigid3& pose, const Rigid3& wanted);

/// Of the poses that the object's symmetry group makes equal, the one whose rotation is nearest to that of
/// `wanted`; of equally near ones the first of the group.
Rigid3 nearestEqualPose(const ObjectModel& model, const Rigid3& pose, const Rigid3& wanted);

}  // namespace monocular_eye_hand
