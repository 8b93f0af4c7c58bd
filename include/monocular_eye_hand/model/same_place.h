#pragma once
#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// From a model's centre in pose a to its centre in pose b, in the frame of both poses [m]. `centre`: in the
/// model's frame, ObjectModel::centre(). Poses that symmetry makes equal share the centre.
Eigen::Vector3d centreOffset(const Eigen::Vector3d& centre, const Rigid3& a, const Rigid3& b);

// The rule that tells which of two sightings are the same thing; who asks brings the reach.

/// One thing stands where the other does when their centres, in one frame, are at most `reach` [m] apart.
bool samePlace(const Eigen::Vector3d& centre_a, const Eigen::Vector3d& centre_b, double reach);
/// Two poses of a model are those of one thing when its centres are at most `reach` [m] apart.
bool samePlace(const Eigen::Vector3d& centre, const Rigid3& a, const Rigid3& b, double reach);
/// The same of what is hollow, and what others lie in: its centres are at most `reach` [m] apart along each
/// axis of pose a.
bool samePlace(const Eigen::Vector3d& centre, const Rigid3& a, const Rigid3& b, const Eigen::Vector3d& reach);

}  // namespace monocular_eye_hand
