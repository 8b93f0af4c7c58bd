#include "monocular_eye_hand/pose/p3p.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "pose/tetrahedron.h"

namespace monocular_eye_hand {
namespace {

/// Altitude over longest side below which three object points count as collinear.
constexpr double kCollinear = 1e-7;

}  // namespace

TetrahedronLegs solveTetrahedron(const Eigen::Matrix3d& bearings, const Eigen::Vector3d& sides) {
  TetrahedronLegs result;
  if (!bearings.allFinite() || !sides.allFinite() || !(sides.minCoeff() > 0)) return result;

  const Eigen::Vector3d squares = sides.cwiseAbs2();
  const TriangleOrder order = longestSideFirst(squares[2], squares[1], squares[0]);
  // side opposite to point k is sides[k]
  const double a = sides[order.third], b = sides[order.second] / a,
               c = sides[order.first] / a;  // a12, a13, a23

  const double x = std::max(b, c), y = std::min(b, c);
  const double area16 = (1 + (x + y)) * (y - (1 - x)) * (y + (1 - x)) * (1 + (x - y));  // Kahan's Heron
  BaseTriangle triangle;
  triangle.a13 = b * b;
  triangle.a23 = c * c;
  triangle.foot = 0.5 * (1 + (b - c) * (b + c));
  if (!(area16 > 0)) return result;
  triangle.altitude = 0.5 * std::sqrt(area16);
  if (triangle.altitude < kCollinear) return result;

  const Eigen::Vector3d j[3] = {bearings.col(order.first), bearings.col(order.second),
                                bearings.col(order.third)};
  TetrahedronRoot roots[4];
  result.count = solveBaseTriangle(j, triangle, roots);
  for (int i = 0; i < result.count; ++i) {
    result.legs[i][order.first] = a * roots[i].legs[0];
    result.legs[i][order.second] = a * roots[i].legs[1];
    result.legs[i][order.third] = a * roots[i].legs[2];
  }
  return result;
}

PoseSolutions solveP3P(const Eigen::Matrix3d& bearings, const Eigen::Matrix3d& points) {
  PoseSolutions result;
  const double a12 = (points.col(0) - points.col(1)).squaredNorm(),
               a13 = (points.col(0) - points.col(2)).squaredNorm(),
               a23 = (points.col(1) - points.col(2)).squaredNorm();
  const TriangleOrder order = longestSideFirst(a12, a13, a23);
  const Eigen::Vector3d p1 = points.col(order.first);
  const Eigen::Vector3d base = points.col(order.second) - p1, side = points.col(order.third) - p1;
  const double base2 = base.squaredNorm();
  if (!(base2 > 0) || !std::isfinite(base2)) return result;
  BaseTriangle triangle;
  const double inverse2 = 1 / base2, inverse = std::sqrt(inverse2), length = base2 * inverse;
  triangle.foot = base.dot(side) * inverse2;
  const Eigen::Vector3d height = side - triangle.foot * base;
  const double height_length = height.norm();
  triangle.altitude = height_length * inverse;
  if (!(triangle.altitude > kCollinear)) return result;
  triangle.a13 = side.squaredNorm() * inverse2;
  triangle.a23 = (side - base).squaredNorm() * inverse2;
  const Eigen::Vector3d j[3] = {bearings.col(order.first), bearings.col(order.second),
                                bearings.col(order.third)};
  TetrahedronRoot roots[4];
  result.count = solveBaseTriangle(j, triangle, roots);
  if (result.count == 0) return result;

  // Two vectors and their cross product on either side (Wong et al. 2.3.4): side 12, altitude, normal.
  const Eigen::Vector3d u = base * inverse, v = height / height_length, w = u.cross(v);
  const Eigen::Vector3d middle = p1 + 0.5 * base;
  const double inverse_altitude = 1 / triangle.altitude;
  for (int i = 0; i < result.count; ++i) {
    const TetrahedronRoot& root = roots[i];
    // of length 1 up to rounding: one Newton step normalises, neither root nor quotient needed
    const Eigen::Vector3d x = root.base * (1.5 - 0.5 * root.base.squaredNorm());
    const Eigen::Vector3d flat = inverse_altitude * (root.height - x * x.dot(root.height));
    const Eigen::Vector3d y = flat * (1.5 - 0.5 * flat.squaredNorm()), z = x.cross(y);
    Rigid3& pose = result.camera_from_object[i];
    pose.rotation.noalias() = x * u.transpose();
    pose.rotation.noalias() += y * v.transpose();
    pose.rotation.noalias() += z * w.transpose();
    pose.translation = (0.5 * length) * (root.legs[0] * j[0] + root.legs[1] * j[1]) - pose.rotation * middle;
  }
  return result;
}

int chooseByFourthPoint(const PoseSolutions& poses, const Eigen::Vector3d& fourth_in_object,
                        const Eigen::Vector3d& fourth, double* error) {
  int best = -1;
  double best_error = 0;
  for (int i = 0; i < poses.count; ++i) {
    const Eigen::Vector3d p = poses.camera_from_object[i] * fourth_in_object;
    const double angle = std::atan2(p.cross(fourth).norm(), p.dot(fourth));
    if (std::isfinite(angle) && (best < 0 || angle < best_error)) {
      best = i;
      best_error = angle;
    }
  }
  if (error && best >= 0) *error = best_error;
  return best;
}

}  // namespace monocular_eye_hand
