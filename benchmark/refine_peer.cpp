#include "refine_peer.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

namespace monocular_eye_hand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Exp(w + d) = Exp(left * d) Exp(w) to first order.
Matrix3d leftJacobian(const Vector3d& w) {
  const double angle2 = w.squaredNorm();
  if (angle2 < 1e-16) return Matrix3d::Identity();
  const double angle = std::sqrt(angle2);
  const Matrix3d k = skew(w);
  return Matrix3d::Identity() + (1 - std::cos(angle)) / angle2 * k +
         (angle - std::sin(angle)) / (angle2 * angle) * k * k;
}

class Reprojection : public ceres::CostFunction {
 public:
  Reprojection(const Camera& camera, const std::vector<PointMatch>& points)
      : camera_(camera), points_(points) {
    set_num_residuals(int(2 * points.size()));
    mutable_parameter_block_sizes()->push_back(6);
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Vector3d w(parameters[0]), t(parameters[0] + 3);
    Matrix3d rotation;
    ceres::AngleAxisToRotationMatrix(w.data(), rotation.data());
    double* jacobian = jacobians ? jacobians[0] : nullptr;
    const Matrix3d left = jacobian ? leftJacobian(w) : Matrix3d();
    for (size_t i = 0; i < points_.size(); ++i) {
      const Vector3d turned = rotation * points_[i].p_in_object, p = turned + t;
      const double z = 1 / p.z(), s = 1 / points_[i].sigma;
      residuals[2 * i] = s * (camera_.fx * p.x() * z + camera_.cx - points_[i].uv.x());
      residuals[2 * i + 1] = s * (camera_.fy * p.y() * z + camera_.cy - points_[i].uv.y());
      if (!jacobian) continue;
      const Vector3d u(s * camera_.fx * z, 0, -s * camera_.fx * p.x() * z * z),
          v(0, s * camera_.fy * z, -s * camera_.fy * p.y() * z * z);
      Eigen::Map<Eigen::Matrix<double, 2, 6, Eigen::RowMajor>> rows(jacobian + 12 * i);
      rows.row(0) << turned.cross(u).transpose() * left, u.transpose();
      rows.row(1) << turned.cross(v).transpose() * left, v.transpose();
    }
    return true;
  }

 private:
  const Camera& camera_;
  const std::vector<PointMatch>& points_;
};

}  // namespace

Rigid3 refineByCeres(const Rigid3& start, const Camera& camera, const std::vector<PointMatch>& points) {
  double parameters[6];
  ceres::RotationMatrixToAngleAxis(start.rotation.data(), parameters);
  for (int i = 0; i < 3; ++i) parameters[3 + i] = start.translation[i];
  ceres::Problem problem;
  problem.AddResidualBlock(new Reprojection(camera, points), nullptr, parameters);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 20;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  Rigid3 pose;
  ceres::AngleAxisToRotationMatrix(parameters, pose.rotation.data());
  pose.translation = Vector3d(parameters[3], parameters[4], parameters[5]);
  return pose;
}

}  // namespace monocular_eye_hand
