#include "calibration/hand_eye.h"

#include <fmt/format.h>

#include <cmath>

#include "calibration/closed_forms.h"
#include "calibration/target_pose.h"
#include "monocular_eye_hand/adjustment/adjust.h"
#include "monocular_eye_hand/adjustment/uncertainty.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/projection.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

/// A point after a transform a, with its derivatives by the point and by perturbed()'s d of a.
struct MovedPoint {
  Eigen::Vector3d q;
  Eigen::Matrix3d by_p;
  Eigen::Matrix<double, 3, 6> by_a;
};

MovedPoint through(const Rigid3& a, const Eigen::Vector3d& p) {
  const Eigen::Vector3d rotated = a.rotation * p;
  MovedPoint moved{rotated + a.translation, a.rotation, {}};
  moved.by_a << Eigen::Matrix3d::Identity(), -skew(rotated);
  return moved;
}

MovedPoint throughInverse(const Rigid3& a, const Eigen::Vector3d& p) {
  const Eigen::Vector3d offset = p - a.translation;
  const Eigen::Matrix3d back = a.rotation.transpose();
  MovedPoint moved{back * offset, back, {}};
  moved.by_a << -back, back * skew(offset);
  return moved;
}

Camera withFocalFactor(Camera camera, double factor) {
  camera.fx *= factor;
  camera.fy *= factor;
  return camera;
}

/// The points of a view: pixel = project(X^-1 A Z (scale p)), where A is base_from_tool of a fixed camera and
/// its inverse of one in the hand. Blocks: X, Z, base_from_tool, (logarithm of the focal factor, logarithm of
/// the scale).
Term pointsOf(const HandEyeView& view, const Camera& camera, const HandEyeOptions& options) {
  Term term;
  term.residuals = 2 * int(view.points.size());
  term.residuals_per_error = 2;
  term.loss = RobustLoss::huber(options.robust_width);
  term.evaluate = [points = view.points, camera, mount = options.mount](
                      const TermValues& at, bool derivatives, TermErrors* errors) {
    const Rigid3& x = at.pose(0);
    const Rigid3& z = at.pose(1);
    const Rigid3& arm = at.pose(2);
    const Camera scaled_camera = withFocalFactor(camera, std::exp(at.vector(3)[0]));
    const double scale = std::exp(at.vector(3)[1]);

    for (size_t i = 0; i < points.size(); ++i) {
      const MovedPoint by_z = through(z, scale * points[i].p_in_target);
      const MovedPoint by_arm =
          mount == CameraMount::kInHand ? throughInverse(arm, by_z.q) : through(arm, by_z.q);
      const MovedPoint by_x = throughInverse(x, by_arm.q);
      if (!(by_x.q.z() > 0)) return false;
      const Projection seen = projectWithDerivatives(scaled_camera, by_x.q);
      const int row = 2 * int(i);
      const double weight = 1 / points[i].sigma;
      errors->residuals.segment<2>(row) = weight * (seen.uv_raw - points[i].uv_raw);
      if (!derivatives) continue;

      const Eigen::Matrix<double, 2, 3> by_q = weight * seen.by_point;
      const Eigen::Matrix<double, 2, 3> by_arm_q = by_q * by_x.by_p;
      const Eigen::Matrix<double, 2, 3> by_z_q = by_arm_q * by_arm.by_p;
      errors->jacobians[0].middleRows<2>(row) = by_q * by_x.by_a;
      errors->jacobians[1].middleRows<2>(row) = by_z_q * by_z.by_a;
      errors->jacobians[2].middleRows<2>(row) = by_arm_q * by_arm.by_a;
      errors->jacobians[3].block<2, 1>(row, 0) = weight * (seen.by_intrinsics.col(0) * scaled_camera.fx +
                                                           seen.by_intrinsics.col(1) * scaled_camera.fy);
      errors->jacobians[3].block<2, 1>(row, 1) = by_z_q * (by_z.q - z.translation);
    }
    return true;
  };
  return term;
}

struct HandEyeProblem {
  AdjustmentProblem problem;
  BlockId x = 0, z = 0, sizes = 0;
  std::vector<BlockId> arms;
};

Matrix6d armCovariance(const HandEyeOptions& options) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(std::pow(options.arm_sigma_translation, 2)),
      Eigen::Vector3d::Constant(std::pow(options.arm_sigma_rotation, 2));
  return variances.asDiagonal();
}

HandEyeProblem problemFrom(const std::vector<HandEyeView>& views, const Camera& camera,
                           const HandEyeOptions& options, const Rigid3& x, const Rigid3& z) {
  HandEyeProblem p;
  p.x = p.problem.addPose("the hand-eye", x);
  p.z = p.problem.addPose("the target", z);
  p.sizes = p.problem.addVector("focal length and target size", Eigen::Vector2d::Zero());
  const double sigmas[] = {options.focal_sigma, options.scale_sigma};
  Eigen::Vector2d variances = Eigen::Vector2d::Ones();
  for (int k = 0; k < 2; ++k) {
    if (sigmas[k] > 0)
      variances[k] = sigmas[k] * sigmas[k];
    else
      p.problem.hold(p.sizes, k);
  }
  p.problem.addPrior(p.sizes, Eigen::VectorXd(Eigen::Vector2d::Zero()), variances.asDiagonal());

  for (size_t v = 0; v < views.size(); ++v) {
    const Rigid3& arm = views[v].base_from_tool;
    p.arms.push_back(p.problem.addPose("the arm at " + views[v].name, arm));
    p.problem.eliminate(p.arms.back());
    p.problem.addPrior(p.arms.back(), arm, armCovariance(options));
    Term term = pointsOf(views[v], camera, options);
    term.blocks = {p.x, p.z, p.arms.back(), p.sizes};
    term.group = int(v);
    p.problem.addTerm(std::move(term));
  }
  return p;
}

std::vector<HandEyePair> pairsOf(const std::vector<HandEyeView>& views, const Camera& camera,
                                 CameraMount mount) {
  std::vector<HandEyePair> pairs;
  for (const HandEyeView& view : views) {
    const std::optional<Rigid3> pose = targetPose(view, camera);
    if (!pose)
      throw BadInput(
          fmt::format("{}: its {} points of the target give no pose: at least four are needed, not on a line",
                      view.name, view.points.size()));
    pairs.push_back(
        {mount == CameraMount::kInHand ? view.base_from_tool : view.base_from_tool.inverse(), *pose});
  }
  return pairs;
}

HandEyeResidual residualOf(const HandEyeView& view, const HandEyeProblem& p, size_t index,
                           const Camera& camera, CameraMount mount) {
  const Rigid3 arm = p.problem.pose(p.arms[index]);
  const Vector6d elsewhere = difference(view.base_from_tool, arm);
  HandEyeResidual residual;
  residual.name = view.name;
  residual.arm_translation = elsewhere.head<3>().norm();
  residual.arm_rotation = elsewhere.tail<3>().norm();

  const Eigen::VectorXd sizes = p.problem.vector(p.sizes);
  const Camera adjusted = withFocalFactor(camera, std::exp(sizes[0]));
  const Rigid3 camera_from_target = p.problem.pose(p.x).inverse() *
                                    (mount == CameraMount::kInHand ? arm.inverse() : arm) *
                                    p.problem.pose(p.z);
  double sum = 0;
  for (const TargetPoint& point : view.points) {
    const Eigen::Vector3d q = camera_from_target * (std::exp(sizes[1]) * point.p_in_target);
    sum += (adjusted.distort(adjusted.project(q)) - point.uv_raw).squaredNorm();
  }
  residual.pixel_rms = std::sqrt(sum / double(view.points.size()));
  return residual;
}

}  // namespace

void HandEyeOptions::check() const {
  requirePositive("arm_sigma_translation", arm_sigma_translation);
  requirePositive("arm_sigma_rotation", arm_sigma_rotation);
  requireNotNegative("focal_sigma", focal_sigma);
  requireNotNegative("scale_sigma", scale_sigma);
  requirePositive("robust_width", robust_width);
}

HandEyeCalibration calibrateHandEye(const std::vector<HandEyeView>& views, const Camera& camera,
                                    const HandEyeOptions& options) {
  options.check();
  camera.check();
  if (views.size() < 3)
    throw BadInput(
        fmt::format("hand-eye calibration needs at least 3 views, better 15: there are {}", views.size()));

  const std::vector<HandEyePair> pairs = pairsOf(views, camera, options.mount);
  const std::vector<HandEyeStart> starts = closedForms(pairs);
  if (starts.empty())
    throw BadInput(
        "the arm turned about one axis only, or hardly: turn the tool by 20 degrees and more about two axes "
        "that are not parallel, and take views there");

  std::optional<HandEyeProblem> best;
  HandEyeCalibration result;
  for (const HandEyeStart& start : starts) {
    HandEyeProblem p = problemFrom(views, camera, options, start.x, meanTarget(pairs, start.x));
    const AdjustmentReport report = adjust(&p.problem);
    if (report.end == AdjustmentEnd::kBadStart || (best && !(report.cost < result.cost))) continue;
    result.cost = report.cost;
    result.start = start.method;
    best = std::move(p);
  }
  if (!best)
    throw BadInput(
        "no closed form puts the target before the camera in all views: are images and poses paired "
        "rightly?");

  const Eigen::VectorXd sizes = best->problem.vector(best->sizes);
  result.mount_from_camera = best->problem.pose(best->x);
  result.target = best->problem.pose(best->z);
  result.camera = withFocalFactor(camera, std::exp(sizes[0]));
  result.target_scale = std::exp(sizes[1]);
  for (size_t v = 0; v < views.size(); ++v)
    result.residuals.push_back(residualOf(views[v], *best, v, camera, options.mount));

  const AdjustmentUncertainty uncertainty(best->problem);
  const auto told = uncertainty.covariance({best->x, best->sizes});
  if (!told)
    throw BadInput("the views leave the hand-eye open: turn the tool about two axes that are not parallel");
  result.covariance = *told;
  return result;
}

}  // namespace monocular_eye_hand
