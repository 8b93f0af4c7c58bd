#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/pose/p3p.h"

namespace monocular_eye_hand {
namespace {

/// Below this volume of the three unit vectors from the lens the inverse of eq. 9 would lose digits.
constexpr double kSmallestVolume = 1e-2;

/// The lens's centre in object coordinates: |p_im - T| = L_i, three quadratic equations. Their differences
/// are linear and leave a line normal to the points' plane; of its two points at distance L_1 the one on the
/// side that the camera sees.
Eigen::Vector3d lensCentre(const Eigen::Matrix3d& p_in_object, const Eigen::Matrix3d& p_in_camera) {
  const Eigen::Vector3d p1 = p_in_object.col(0), q = p_in_object.col(1) - p1, r = p_in_object.col(2) - p1;
  const Eigen::Vector3d legs2 = p_in_camera.colwise().squaredNorm();
  const Eigen::Vector3d normal = q.cross(r);
  // (T - p1) . q = (L1^2 - L2^2 + |q|^2) / 2, likewise r
  const double along_q = 0.5 * (legs2[0] - legs2[1] + q.squaredNorm()),
               along_r = 0.5 * (legs2[0] - legs2[2] + r.squaredNorm());
  const double normal2 = normal.squaredNorm();
  const Eigen::Vector3d in_plane = (along_q * r.cross(normal) + along_r * normal.cross(q)) / normal2;
  const double height = std::sqrt(std::max(0.0, legs2[0] - in_plane.squaredNorm()));
  const double side = p_in_camera.determinant() > 0 ? -1 : 1;  // det(p_m - T) = -(T - p1) . (q x r)
  return p1 + in_plane + (side * height / std::sqrt(normal2)) * normal;
}

Eigen::Matrix3d axes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix3d m;
  m.col(0) = a.normalized();
  m.col(2) = a.cross(b).normalized();
  m.col(1) = m.col(2).cross(m.col(0));
  return m;
}

}  // namespace

Rigid3 objectFromCamera(const Eigen::Matrix3d& p_in_object, const Eigen::Matrix3d& p_in_camera) {
  Rigid3 object_from_camera;
  const double volume = std::abs(p_in_camera.determinant()) / p_in_camera.colwise().norm().prod();
  if (volume > kSmallestVolume) {
    const Eigen::Vector3d t = lensCentre(p_in_object, p_in_camera);
    object_from_camera.rotation =
        nearestRotation((p_in_object.colwise() - t) * p_in_camera.inverse());  // eq. 9
    object_from_camera.translation = t;
    return object_from_camera;
  }

  // Figure 6: the lens lies (nearly) in the plane of the points. The two vectors run between the points
  // rather than from the lens, so that T, whose height over that plane is badly known, is not needed to find
  // R.
  int first = 0, second = 1, third = 2;  // the farthest pair first
  const double d12 = (p_in_object.col(0) - p_in_object.col(1)).squaredNorm(),
               d13 = (p_in_object.col(0) - p_in_object.col(2)).squaredNorm(),
               d23 = (p_in_object.col(1) - p_in_object.col(2)).squaredNorm();
  if (d13 > d12 && d13 >= d23) {
    second = 2;
    third = 1;
  } else if (d23 > d12) {
    first = 1;
    second = 2;
    third = 0;
  }

  const auto vectors = [&](const Eigen::Matrix3d& p) {
    return axes(p.col(second) - p.col(first), p.col(third) - p.col(first));
  };
  object_from_camera.rotation = vectors(p_in_object) * vectors(p_in_camera).transpose();
  object_from_camera.translation =
      p_in_object.rowwise().mean() - object_from_camera.rotation * p_in_camera.rowwise().mean();
  return object_from_camera;
}

}  // namespace monocular_eye_hand
