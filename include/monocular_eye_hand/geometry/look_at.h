#pragma once
#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// world_from_camera of a camera (optical frame) at `eye` that looks at `target`; image up is world z up,
/// then turned by `roll` [rad] about the viewing axis. Throws BadInput when eye and target coincide.
Rigid3 lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double roll = 0);
/// The same from azimuth and elevation [rad] about `target` at `distance` [m].
Rigid3 lookFrom(double azimuth, double elevation, double distance, const Eigen::Vector3d& target,
                double roll = 0);

}  // namespace monocular_eye_hand
