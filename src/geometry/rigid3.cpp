#include "monocular_eye_hand/geometry/rigid3.h"

#include <Eigen/SVD>
#include <cmath>

namespace monocular_eye_hand {

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Eigen::Matrix3d expSO3(const Eigen::Vector3d& w) {
  const double angle2 = w.squaredNorm();
  const Eigen::Matrix3d k = skew(w);
  double a, b;  // R = I + a K + b K^2
  if (angle2 < 1e-8) {
    a = 1.0 - angle2 / 6.0;
    b = 0.5 - angle2 / 24.0;
  } else {
    const double angle = std::sqrt(angle2);
    a = std::sin(angle) / angle;
    b = (1.0 - std::cos(angle)) / angle2;
  }
  return Eigen::Matrix3d::Identity() + a * k + b * k * k;
}

Eigen::Vector3d logSO3(const Eigen::Matrix3d& rotation) {
  // By way of the quaternion: accurate at every angle, pi included.
  Eigen::Quaterniond q(rotation);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double s = q.vec().norm();
  if (s < 1e-12) return 2.0 * q.vec();
  return (2.0 * std::atan2(s, q.w()) / s) * q.vec();
}

double angleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return logSO3(a.transpose() * b).norm();
}

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

Rigid3 perturbed(const Rigid3& a_from_b, const Vector6d& d) {
  return {expSO3(d.tail<3>()) * a_from_b.rotation, a_from_b.translation + d.head<3>()};
}

Vector6d difference(const Rigid3& a, const Rigid3& b) {
  Vector6d d;
  d << b.translation - a.translation, logSO3(b.rotation * a.rotation.transpose());
  return d;
}

}  // namespace monocular_eye_hand
