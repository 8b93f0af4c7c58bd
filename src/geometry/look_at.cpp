#include "monocular_eye_hand/geometry/look_at.h"

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

Rigid3 lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double roll) {
  const Eigen::Vector3d forward = target - eye;
  if (!(forward.norm() > 1e-9)) throw BadInput("lookAt: eye and target coincide");
  const Eigen::Vector3d z = forward.normalized();
  // Straight down there is no "up": take world y then.
  const Eigen::Vector3d up = std::abs(z.z()) > 1 - 1e-9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d x = z.cross(up).normalized();
  Rigid3 world_from_camera;
  world_from_camera.rotation.col(0) = x;
  world_from_camera.rotation.col(1) = z.cross(x);
  world_from_camera.rotation.col(2) = z;
  world_from_camera.rotation *= expSO3({0, 0, roll});
  world_from_camera.translation = eye;
  return world_from_camera;
}

Rigid3 lookFrom(double azimuth, double elevation, double distance, const Eigen::Vector3d& target,
                double roll) {
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  return lookAt(target + distance * direction, target, roll);
}

}  // namespace monocular_eye_hand
