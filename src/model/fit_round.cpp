#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "model/surfaces.h"

namespace monocular_eye_hand {
namespace {

struct Circle2 {
  bool valid = false;
  Eigen::Vector2d centre;
  double radius = 0;
};

/// Algebraic circle fit (Kasa 1976) about the points' mean, scaled for conditioning.
Circle2 fitCircle2(const std::vector<Eigen::Vector2d>& points) {
  Circle2 out;
  if (points.size() < 3) return out;

  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p / double(points.size());
  double scale = 0;
  for (const auto& p : points) scale = std::max(scale, (p - mean).norm());
  if (!(scale > 0)) return out;

  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const auto& p : points) {
    const Eigen::Vector2d q = (p - mean) / scale;
    const Eigen::Vector3d row(2 * q.x(), 2 * q.y(), 1);
    a += row * row.transpose();
    b += row * q.squaredNorm();
  }

  const Eigen::LDLT<Eigen::Matrix3d> ldlt(a);
  if (ldlt.info() != Eigen::Success || ldlt.vectorD().cwiseAbs().minCoeff() < 1e-14) return out;
  const Eigen::Vector3d x = ldlt.solve(b);
  const double r2 = x.z() + x.head<2>().squaredNorm();
  if (!x.allFinite() || !(r2 > 0)) return out;

  out.centre = mean + scale * x.head<2>();
  out.radius = scale * std::sqrt(r2);
  out.valid = true;
  return out;
}

}  // namespace

CylinderFit fitCylinder(const std::vector<Eigen::Vector3d>& points,
                        const std::vector<Eigen::Vector3d>& normals, const std::vector<double>& weights) {
  CylinderFit fit;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (size_t k = 0; k < normals.size(); ++k) scatter += weights[k] * normals[k] * normals[k].transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  fit.axis = eigen.eigenvectors().col(0);
  const Eigen::Vector3d u = fit.axis.unitOrthogonal(), v = fit.axis.cross(u);

  std::vector<Eigen::Vector2d> flat;
  for (const Eigen::Vector3d& p : points) flat.emplace_back(u.dot(p), v.dot(p));
  const Circle2 circle = fitCircle2(flat);
  if (!circle.valid) return fit;

  double low = 1e300, high = -1e300;
  for (size_t k = 0; k < points.size(); ++k) {
    fit.residual = std::max(fit.residual, std::abs((flat[k] - circle.centre).norm() - circle.radius));
    low = std::min(low, fit.axis.dot(points[k]));
    high = std::max(high, fit.axis.dot(points[k]));
  }

  fit.radius = circle.radius;
  fit.point = u * circle.centre.x() + v * circle.centre.y() + fit.axis * (0.5 * (low + high));
  fit.valid = true;
  return fit;
}

CircleFit fitCircle(const std::vector<Eigen::Vector3d>& points) {
  CircleFit fit;
  if (points.size() < 3) return fit;

  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p / double(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& p : points) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  fit.axis = eigen.eigenvectors().col(0);
  const Eigen::Vector3d u = eigen.eigenvectors().col(2), v = fit.axis.cross(u);

  std::vector<Eigen::Vector2d> flat;
  for (const auto& p : points) flat.emplace_back(u.dot(p - mean), v.dot(p - mean));
  const Circle2 circle = fitCircle2(flat);
  if (!circle.valid) return fit;

  fit.centre = mean + u * circle.centre.x() + v * circle.centre.y();
  fit.radius = circle.radius;
  for (size_t k = 0; k < points.size(); ++k) {
    const double in_plane = (flat[k] - circle.centre).norm() - circle.radius;
    fit.residual = std::max(fit.residual, std::hypot(in_plane, fit.axis.dot(points[k] - mean)));
  }
  fit.valid = true;
  return fit;
}

}  // namespace monocular_eye_hand
