#include "monocular_eye_hand/model/same_place.h"

namespace monocular_eye_hand {

Eigen::Vector3d centreOffset(const Eigen::Vector3d& centre, const Rigid3& a, const Rigid3& b) {
  return b * centre - a * centre;
}

bool samePlace(const Eigen::Vector3d& centre_a, const Eigen::Vector3d& centre_b, double reach) {
  return (centre_b - centre_a).norm() <= reach;
}

bool samePlace(const Eigen::Vector3d& centre, const Rigid3& a, const Rigid3& b, double reach) {
  return samePlace(a * centre, b * centre, reach);
}

bool samePlace(const Eigen::Vector3d& centre, const Rigid3& a, const Rigid3& b,
               const Eigen::Vector3d& reach) {
  const Eigen::Vector3d along_axes = a.rotation.transpose() * centreOffset(centre, a, b);
  return (along_axes.cwiseAbs().array() <= reach.array()).all();
}

}  // namespace monocular_eye_hand
