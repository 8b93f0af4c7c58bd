#include "monocular_eye_hand/recognition/pose_covariance.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <map>

namespace monocular_eye_hand {
namespace {

// Errors of edge positions relative to the CAD model, measured on rendered scenes with truth: of a sample by
// itself and of a whole feature [px].
constexpr double kSampleSigma = 0.3, kFeatureSigma = 0.22;
constexpr double kOutlier = 1.5;  // residuals beyond this belong to something else [px]
// What is known of a pose without any feature [m, rad]: keeps the inverse finite.
constexpr double kPriorMetres = 1.0, kPriorRadians = 1.8;

}  // namespace

Matrix6d contourCovariance(const Rigid3& pose, const Camera& camera, const std::vector<LineMatch>& matches,
                           const std::vector<int>& groups, const FreeAxis& axis) {
  Matrix6d information = Matrix6d::Zero(), scatter = Matrix6d::Zero();
  for (int i = 0; i < 3; ++i) {
    information(i, i) = 1 / (kPriorMetres * kPriorMetres);
    information(i + 3, i + 3) = 1 / (kPriorRadians * kPriorRadians);
  }
  scatter = information;
  const double weight = 1 / (kSampleSigma * kSampleSigma);
  std::map<int, Vector6d> by_feature;
  for (size_t i = 0; i < matches.size(); ++i) {
    Vector6d j;
    const double residual = lineResidual(pose, camera, matches[i], &j);
    if (!(std::abs(residual) < kOutlier) || !j.allFinite()) continue;
    information += weight * j * j.transpose();
    scatter += weight * j * j.transpose();
    by_feature.try_emplace(groups[i], Vector6d::Zero()).first->second += weight * j;
  }
  for (const auto& [group, sum] : by_feature)
    scatter += kFeatureSigma * kFeatureSigma * sum * sum.transpose();

  Vector6d turn = Vector6d::Zero();
  if (axis.present) {
    const Eigen::Vector3d direction = pose.rotation * axis.direction;
    const Eigen::Vector3d arm = pose.translation - pose * axis.point;
    turn << direction.cross(arm), direction;
    information += 1e9 * turn * turn.transpose();  // held; its own variance is added below
  }
  const Matrix6d inverse = information.ldlt().solve(Matrix6d::Identity());
  Matrix6d covariance = inverse * scatter * inverse;
  if (axis.present) covariance += M_PI * M_PI / 3 * turn * turn.transpose();
  return 0.5 * (covariance + covariance.transpose());
}

}  // namespace monocular_eye_hand
