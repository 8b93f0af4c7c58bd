#include "monocular_eye_hand/geometry/ellipse.h"

#include <Eigen/Dense>
#include <cmath>

namespace monocular_eye_hand {

Eigen::Vector2d Ellipse::at(double parameter) const {
  const double x = a * std::cos(parameter), y = b * std::sin(parameter);
  const double c = std::cos(angle), s = std::sin(angle);
  return {centre.x() + c * x - s * y, centre.y() + s * x + c * y};
}

Eigen::Matrix3d Ellipse::conic() const {
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix2d r;
  r << c, -s, s, c;
  Eigen::Matrix2d m = r * Eigen::Vector2d(1 / (a * a), 1 / (b * b)).asDiagonal() * r.transpose();
  m(1, 0) = m(0, 1);  // exactly symmetric
  Eigen::Matrix3d conic;
  conic.topLeftCorner<2, 2>() = m;
  conic.topRightCorner<2, 1>() = -m * centre;
  conic.bottomLeftCorner<1, 2>() = conic.topRightCorner<2, 1>().transpose();
  conic(2, 2) = centre.dot(m * centre) - 1;
  return conic / conic.norm();
}

EllipseFromConic ellipseFromConic(const Eigen::Matrix3d& conic) {
  EllipseFromConic result;
  if (!conic.allFinite()) return result;
  Eigen::Matrix2d m = conic.topLeftCorner<2, 2>();
  Eigen::Vector2d v = conic.topRightCorner<2, 1>();
  double w = conic(2, 2);
  const double det = m.determinant();
  if (!(det > 1e-14 * m.squaredNorm())) return result;
  if (m.trace() < 0) {
    m = -m;
    v = -v;
    w = -w;
  }

  const Eigen::Vector2d centre = -m.inverse() * v;
  const double level = -(w + v.dot(centre));  // (x - c)^T M (x - c) = level
  if (!(level > 0)) return result;

  // Eigenvalues of M; the small one, the long axis', by the determinant, which keeps its digits.
  const double half = 0.5 * (m(1, 1) - m(0, 0));
  const double large = 0.5 * m.trace() + std::hypot(half, m(0, 1)), small = det / large;
  result.ellipse = {centre, std::sqrt(level / small), std::sqrt(level / large),
                    0.5 * std::atan2(-m(0, 1), half)};
  result.valid = std::isfinite(result.ellipse.a) && std::isfinite(result.ellipse.b) && result.ellipse.b > 0;
  return result;
}

}  // namespace monocular_eye_hand
