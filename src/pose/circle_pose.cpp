#include "monocular_eye_hand/pose/circle_pose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

/// Eigenvectors (columns) and eigenvalues of a symmetric matrix by Jacobi's rotations: they keep the small
/// eigenvalue of a graded matrix (a narrow cone) to full relative accuracy, which tridiagonal methods do not.
void jacobiEigen(Eigen::Matrix3d m, Eigen::Matrix3d* vectors, Eigen::Vector3d* values) {
  vectors->setIdentity();
  for (int sweep = 0; sweep < 30; ++sweep) {
    bool done = true;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (std::abs(m(p, q)) <= 1e-18 * std::sqrt(std::abs(m(p, p) * m(q, q)))) continue;
        done = false;
        const double theta = (m(q, q) - m(p, p)) / (2 * m(p, q));
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c, off = m(p, q);

        const int r = 3 - p - q;
        const double rp = m(r, p), rq = m(r, q);
        m(p, p) -= t * off;
        m(q, q) += t * off;
        m(p, q) = m(q, p) = 0;
        m(r, p) = m(p, r) = c * rp - s * rq;
        m(r, q) = m(q, r) = s * rp + c * rq;

        const Eigen::Vector3d vp = vectors->col(p), vq = vectors->col(q);
        vectors->col(p) = c * vp - s * vq;
        vectors->col(q) = s * vp + c * vq;
      }
    if (done) break;
  }
  *values = m.diagonal();
}

}  // namespace

CirclePoses circlePoses(const Ellipse& ellipse, const Camera& camera, double radius) {
  CirclePoses result;
  if (!(ellipse.a > 0 && ellipse.b > 0 && radius > 0) || !std::isfinite(ellipse.a + radius) ||
      !ellipse.centre.allFinite() || !std::isfinite(ellipse.angle))
    return result;

  // The cone's rays are middle + half (cos t, sin t) on the plane z = 1, here in axes whose z is the middle
  // ray.
  const double c = std::cos(ellipse.angle), s = std::sin(ellipse.angle);
  Eigen::Matrix3d rays;
  rays << ellipse.a * c / camera.fx, -ellipse.b * s / camera.fx,
      (ellipse.centre.x() - camera.cx) / camera.fx,                                                        //
      ellipse.a * s / camera.fy, ellipse.b * c / camera.fy, (ellipse.centre.y() - camera.cy) / camera.fy,  //
      0, 0, 1;
  const Eigen::Vector3d middle = rays.col(2);
  const Eigen::Matrix3d rotation =
      Eigen::Quaterniond::FromTwoVectors(middle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  rays.leftCols<2>() = (rotation * rays.leftCols<2>()).eval();
  rays.col(2) = Eigen::Vector3d(0, 0, middle.norm());

  // Q = rays^-T diag(1, 1, -1) rays^-1, the inverse by cross products
  const Eigen::Vector3d r0 = rays.col(1).cross(rays.col(2)), r1 = rays.col(2).cross(rays.col(0)),
                        r2 = rays.col(0).cross(rays.col(1));
  const double volume = rays.col(2).dot(r2);
  if (!(std::abs(volume) > 0)) return result;
  Eigen::Matrix3d q = r0 * r0.transpose() + r1 * r1.transpose() - r2 * r2.transpose();
  const double scale = 1 / (volume * volume);
  q *= scale;
  if (!q.allFinite()) return result;

  Eigen::Matrix3d v;
  Eigen::Vector3d l;
  jacobiEigen(q, &v, &l);
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int i, int k) { return l[i] > l[k]; });
  const double l1 = l[order[0]], l2 = l[order[1]], l3 = l[order[2]];
  if (!(l2 > 0 && l3 < 0)) return result;

  // Safaee-Rad et al. 1992, in the closed form of Chen et al. 2004
  const double sine = std::sqrt(std::max(0.0, (l1 - l2) / (l1 - l3))),
               cosine = std::sqrt((l2 - l3) / (l1 - l3));
  const double range = radius / std::sqrt(-l1 * l3);
  const Eigen::Vector3d e1 = rotation.transpose() * v.col(order[0]),
                        e3 = rotation.transpose() * v.col(order[2]);
  for (int i = 0; i < 2; ++i) {
    const double sign = i == 0 ? 1 : -1;
    Eigen::Vector3d normal = sign * sine * e1 + cosine * e3;
    Eigen::Vector3d centre = range * (sign * sine * l3 * e1 + cosine * l1 * e3);
    if (centre.z() < 0) centre = -centre;
    if (normal.dot(centre) > 0) normal = -normal;
    result.pose[i] = {centre, normal.normalized()};
  }
  if (result.pose[1].normal.y() < result.pose[0].normal.y()) std::swap(result.pose[0], result.pose[1]);
  result.count = 2;
  return result;
}

}  // namespace monocular_eye_hand
