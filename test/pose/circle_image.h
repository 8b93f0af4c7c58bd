#pragma once
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/ellipse.h"

namespace monocular_eye_hand {

/// The image of a circle (camera frame), calculated in long double: what is left is the rounding of the
/// ellipse's five parameters.
inline Ellipse imageOfCircle(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double radius,
                             const Camera& camera) {
  using Matrix3l = Eigen::Matrix<long double, 3, 3>;
  using Matrix2l = Eigen::Matrix<long double, 2, 2>;
  using Vector3l = Eigen::Matrix<long double, 3, 1>;
  using Vector2l = Eigen::Matrix<long double, 2, 1>;
  const Vector3l n = normal.cast<long double>().normalized(), u = n.unitOrthogonal(), v = n.cross(u);
  Matrix3l k = Matrix3l::Zero(), plane;
  k(0, 0) = camera.fx;
  k(1, 1) = camera.fy;
  k(0, 2) = camera.cx;
  k(1, 2) = camera.cy;
  k(2, 2) = 1;
  plane << radius * u, radius * v, centre.cast<long double>();
  const Matrix3l inverse = (k * plane).inverse();
  const Matrix3l conic = inverse.transpose() * Vector3l(1, 1, -1).asDiagonal() * inverse;
  const Matrix2l a = conic.topLeftCorner<2, 2>();
  const Vector2l middle = -a.inverse() * conic.topRightCorner<2, 1>();
  const long double level = -(conic(2, 2) + middle.dot(conic.topRightCorner<2, 1>()));
  const long double half = (a(0, 0) + a(1, 1)) / 2, spread = std::hypot((a(0, 0) - a(1, 1)) / 2, a(0, 1));
  Ellipse e;
  e.centre = middle.cast<double>();
  e.a = double(std::sqrt(level / (half - spread)));
  e.b = double(std::sqrt(level / (half + spread)));
  e.angle = double(std::atan2(-2 * a(0, 1), a(1, 1) - a(0, 0)) / 2);
  return e;
}

}  // namespace monocular_eye_hand
