#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace monocular_eye_hand {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// A rigid transform `a_from_b`: maps coordinates in frame b to coordinates in frame a. Products read right
/// to left and equal neighbours cancel: `base_from_tool * tool_from_camera * camera_from_object` (tf's
/// lookupTransform(target = a, source = b)). p_m = R p_c + T of Wong et al. is `object_from_camera`.
struct Rigid3 {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< metres

  Rigid3 inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
  Eigen::Quaterniond quaternion() const { return Eigen::Quaterniond(rotation); }
  bool isFinite() const { return rotation.allFinite() && translation.allFinite(); }
};

inline Rigid3 operator*(const Rigid3& a_from_b, const Rigid3& b_from_c) {
  return {a_from_b.rotation * b_from_c.rotation,
          a_from_b.rotation * b_from_c.translation + a_from_b.translation};
}
inline Eigen::Vector3d operator*(const Rigid3& a_from_b, const Eigen::Vector3d& p_in_b) {
  return a_from_b.rotation * p_in_b + a_from_b.translation;
}

/// Cross-product matrix: skew(a) b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);
/// Rotation by |w| radians about w (Rodrigues).
Eigen::Matrix3d expSO3(const Eigen::Vector3d& w);
/// Inverse of expSO3; the angle is in [0, pi].
Eigen::Vector3d logSO3(const Eigen::Matrix3d& rotation);
/// Angle of the rotation that takes a to b [rad].
double angleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);
/// Nearest rotation matrix (Frobenius norm).
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& m);

/// Applies a small motion d = (x, y, z, rotation about x, y, z), metres and radians, about the fixed axes of
/// the target frame: rotation' = Exp(d_rot) rotation, translation' = translation + d_xyz. 6x6 covariances use
/// this order and these axes, as geometry_msgs/PoseWithCovariance does.
Rigid3 perturbed(const Rigid3& a_from_b, const Vector6d& d);
/// The d with perturbed(a, d) = b.
Vector6d difference(const Rigid3& a, const Rigid3& b);

}  // namespace monocular_eye_hand
