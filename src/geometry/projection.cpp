#include "monocular_eye_hand/geometry/projection.h"

#include <cmath>

namespace monocular_eye_hand {
namespace {

using ByCoefficients = Eigen::Matrix<double, 2, 8>;

/// Derivatives of the distorted point at z = 1 by k1, k2, p1, p2, k3 to k6, see Camera.
ByCoefficients polynomialsByCoefficients(const std::array<double, 8>& d, const Eigen::Vector2d& p) {
  const double x = p.x();
  const double y = p.y();
  const double r2 = p.squaredNorm();
  const double num = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  const double den = 1 + r2 * (d[5] + r2 * (d[6] + r2 * d[7]));
  const Eigen::Vector2d above = p / den;
  const Eigen::Vector2d below = -num / den * above;

  ByCoefficients out;
  out << above * r2, above * r2 * r2, Eigen::Vector2d(2 * x * y, r2 + 2 * y * y),
      Eigen::Vector2d(r2 + 2 * x * x, 2 * x * y), above * r2 * r2 * r2, below * r2, below * r2 * r2,
      below * r2 * r2 * r2;
  return out;
}

/// The same by k1 to k4 of an equidistant lens.
ByCoefficients equidistantByCoefficients(const Eigen::Vector2d& p) {
  const double r = p.norm();
  const double theta = std::atan(r);
  const Eigen::Vector2d outward = r > 0 ? Eigen::Vector2d(p / r) : Eigen::Vector2d::Zero();

  ByCoefficients out = ByCoefficients::Zero();
  for (int k = 0; k < 4; ++k) out.col(k) = outward * std::pow(theta, 2 * k + 3);
  return out;
}

ByCoefficients byCoefficients(const Camera& camera, const Eigen::Vector2d& p) {
  switch (camera.model) {
    case DistortionModel::kEquidistant:
      return equidistantByCoefficients(p);
    case DistortionModel::kRationalPolynomial:
      return polynomialsByCoefficients(camera.d, p);
    case DistortionModel::kPlumbBob: {
      ByCoefficients out = polynomialsByCoefficients(camera.d, p);
      out.rightCols<3>().setZero();
      return out;
    }
    case DistortionModel::kNone:
      break;
  }
  return ByCoefficients::Zero();
}

}  // namespace

Projection projectWithDerivatives(const Camera& camera, const Eigen::Vector3d& p_in_camera) {
  const double z = 1 / p_in_camera.z();
  const Eigen::Vector2d at_one = p_in_camera.head<2>() * z;
  const DistortedPixel seen = camera.distortWithJacobian(camera.project(p_in_camera));
  const Eigen::Vector2d focal(camera.fx, camera.fy);
  Projection out;
  out.uv_raw = seen.uv_raw;

  Eigen::Matrix<double, 2, 3> rect_by_point;
  rect_by_point << camera.fx * z, 0, -camera.fx * at_one.x() * z, 0, camera.fy * z,
      -camera.fy * at_one.y() * z;
  out.by_point = seen.jacobian * rect_by_point;

  const Eigen::Vector2d distorted((seen.uv_raw.x() - camera.cx) / camera.fx,
                                  (seen.uv_raw.y() - camera.cy) / camera.fy);
  out.by_intrinsics.leftCols<2>() = distorted.asDiagonal();
  out.by_intrinsics.middleCols<2>(2).setIdentity();
  out.by_intrinsics.rightCols<8>() = focal.asDiagonal() * byCoefficients(camera, at_one);
  return out;
}

}  // namespace monocular_eye_hand
