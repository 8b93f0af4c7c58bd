#include "calibration/homography.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace monocular_eye_hand {
namespace {

/// Takes points to mean 0 and a mean distance of sqrt(2); nothing when they all coincide.
std::optional<Eigen::Matrix3d> normalisation(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points) mean += p / double(points.size());
  double distance = 0;
  for (const Eigen::Vector2d& p : points) distance += (p - mean).norm() / double(points.size());
  if (!(distance > 0)) return {};

  const double scale = std::sqrt(2.0) / distance;
  Eigen::Matrix3d t = Eigen::Matrix3d::Identity();
  t.topLeftCorner<2, 2>() *= scale;
  t.topRightCorner<2, 1>() = -scale * mean;
  return t;
}

Eigen::Vector3d homogeneous(const Eigen::Vector2d& p) { return {p.x(), p.y(), 1}; }

}  // namespace

std::optional<Eigen::Matrix3d> homographyOf(const CalibrationView& view) {
  std::vector<Eigen::Vector2d> plane, image;
  for (const TargetPoint& p : view.points) {
    if (std::abs(p.p_in_target.z()) > 1e-9) return {};
    plane.emplace_back(p.p_in_target.head<2>());
    image.push_back(p.uv_raw);
  }
  if (plane.size() < 4) return {};
  const auto of_plane = normalisation(plane);
  const auto of_image = normalisation(image);
  if (!of_plane || !of_image) return {};

  using Matrix9d = Eigen::Matrix<double, 9, 9>;
  Matrix9d sum = Matrix9d::Zero();
  for (size_t i = 0; i < plane.size(); ++i) {
    const Eigen::Vector3d p = *of_plane * homogeneous(plane[i]);
    const Eigen::Vector3d q = *of_image * homogeneous(image[i]);
    Eigen::Matrix<double, 2, 9> rows = Eigen::Matrix<double, 2, 9>::Zero();
    rows.block<1, 3>(0, 0) = p.transpose();
    rows.block<1, 3>(0, 6) = -q.x() * p.transpose();
    rows.block<1, 3>(1, 3) = p.transpose();
    rows.block<1, 3>(1, 6) = -q.y() * p.transpose();
    sum += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix9d> eigen(sum);
  if (eigen.eigenvalues()[1] < 1e-9 * eigen.eigenvalues()[8]) return {};  // of points on a line many fit

  const Eigen::Matrix<double, 9, 1> h = eigen.eigenvectors().col(0);
  Eigen::Matrix3d normalised;
  normalised << h.segment<3>(0).transpose(), h.segment<3>(3).transpose(), h.segment<3>(6).transpose();
  return Eigen::Matrix3d(of_image->inverse() * normalised * *of_plane);
}

std::optional<Eigen::Vector2d> focalLengths(const std::vector<Eigen::Matrix3d>& image_from_plane,
                                            const Eigen::Vector2d& principal_point) {
  // With a = 1 / fx^2 and b = 1 / fy^2: h1 . diag(a, b, 1) h2 = 0 and h1 . diag h1 = h2 . diag h2.
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  Eigen::Matrix3d centred = Eigen::Matrix3d::Identity();
  centred.topRightCorner<2, 1>() = -principal_point;
  for (const Eigen::Matrix3d& h : image_from_plane) {
    const Eigen::Matrix3d m = centred * h / h.col(0).norm();
    const Eigen::Vector3d products[] = {m.col(0).cwiseProduct(m.col(1)),
                                        m.col(0).cwiseProduct(m.col(0)) - m.col(1).cwiseProduct(m.col(1))};
    for (const Eigen::Vector3d& p : products) {
      normal += p.head<2>() * p.head<2>().transpose();
      right -= p.head<2>() * p.z();
    }
  }

  // Square pixels where the views cannot tell the two apart.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(normal);
  Eigen::Vector2d inverse_squares = normal.inverse() * right;
  if (eigen.eigenvalues()[0] < 1e-4 * eigen.eigenvalues()[1] || !(inverse_squares.minCoeff() > 0))
    inverse_squares.setConstant(right.sum() / normal.sum());
  if (!inverse_squares.allFinite() || !(inverse_squares.minCoeff() > 0)) return {};
  return Eigen::Vector2d(inverse_squares.cwiseInverse().cwiseSqrt());
}

}  // namespace monocular_eye_hand
