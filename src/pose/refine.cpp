#include "monocular_eye_hand/pose/refine.h"
#include "monocular_eye_hand/geometry/require.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "pose/normal_equations.h"

namespace monocular_eye_hand {
namespace {

constexpr double kFreeVariance = M_PI * M_PI / 3;  // of an angle of which nothing is known

bool usable(const Rigid3& start, const Camera& camera, const std::vector<LineMatch>& lines,
            const std::vector<PointMatch>& points, const FreeAxis& axis) {
  double sum = camera.fx + camera.fy + camera.cx + camera.cy;  // not finite as soon as one term is not
  bool positive = true;
  for (const LineMatch& m : lines) {
    sum += m.p_in_object.sum() + m.uv.sum() + m.normal.sum() + m.sigma;
    positive &= m.sigma > 0;
  }
  for (const PointMatch& m : points) {
    sum += m.p_in_object.sum() + m.uv.sum() + m.sigma;
    positive &= m.sigma > 0;
  }
  if (axis.present) {
    sum += axis.point.sum() + axis.direction.sum();
    positive &= axis.direction.squaredNorm() > 0;
  }
  return start.isFinite() && std::isfinite(sum) && positive && (!lines.empty() || !points.empty());
}

/// The step's six coordinates: along the axes, or, with a free axis, the last one along the rotation that is
/// held.
struct Coordinates {
  Eigen::Matrix3d rotation_axes = Eigen::Matrix3d::Identity();  // columns; the free one last
  bool held = false;

  Coordinates(const Rigid3& pose, const FreeAxis& axis) : held(axis.present) {
    if (!held) return;
    const Eigen::Vector3d free = (pose.rotation * axis.direction).normalized();
    rotation_axes.col(2) = free;
    rotation_axes.col(0) = free.unitOrthogonal();
    rotation_axes.col(1) = free.cross(rotation_axes.col(0));
  }
  void rotate(Matrix6d* h, Vector6d* g) const {
    if (!held) return;
    h->rightCols<3>() = (h->rightCols<3>() * rotation_axes).eval();
    h->bottomRows<3>() = (rotation_axes.transpose() * h->bottomRows<3>()).eval();
    g->tail<3>() = (rotation_axes.transpose() * g->tail<3>()).eval();
    h->row(5).setZero();
    h->col(5).setZero();
    (*h)(5, 5) = 1;
    (*g)[5] = 0;
  }
  Vector6d back(const Vector6d& step) const {
    if (!held) return step;
    Vector6d d = step;
    d.tail<3>() = rotation_axes * step.tail<3>();
    return d;
  }
};

/// (h + lambda diag h) x = -g; false when not positive definite.
bool dampedStep(const Matrix6d& h, const Vector6d& g, double lambda, Vector6d* step) {
  Matrix6d damped = h;
  const double floor = 1e-14 * h.diagonal().maxCoeff();
  for (int i = 0; i < 6; ++i) damped(i, i) += lambda * h(i, i) + floor;
  const Eigen::LLT<Matrix6d> llt(damped);
  if (llt.info() != Eigen::Success) return false;
  *step = -llt.solve(g);
  return step->allFinite();
}

/// Full rank, judged on the matrix with unit diagonal.
bool fullRank(const Matrix6d& h) {
  const Vector6d d = h.diagonal();
  if (!(d.minCoeff() > 0) || !h.allFinite()) return false;
  const Vector6d s = d.cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Matrix6d> ldlt(s.asDiagonal() * h * s.asDiagonal());
  return ldlt.info() == Eigen::Success && ldlt.vectorD().minCoeff() > 1e-10;
}

/// Inverse of a singular information matrix with a weak prior, 1 m and pi / sqrt(3) rad. What rounding leaves
/// in the open directions may exceed the prior by far, so they are told by their eigenvalues.
Matrix6d inverseWithPrior(const Matrix6d& information) {
  Vector6d prior;
  prior << 1, 1, 1, Eigen::Vector3d::Constant(std::sqrt(kFreeVariance));
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(prior.asDiagonal() * information * prior.asDiagonal());
  const double open = 1e-12 * eigen.eigenvalues()[5];
  Vector6d variances;
  for (int i = 0; i < 6; ++i)
    variances[i] = eigen.eigenvalues()[i] > open ? 1 / (1 + eigen.eigenvalues()[i]) : 1;
  const Matrix6d axes = prior.asDiagonal() * eigen.eigenvectors();
  return axes * variances.asDiagonal() * axes.transpose();
}

void covarianceOf(const NormalEquations& at, const FreeAxis& axis, RefinedPose* result) {
  const Rigid3& pose = result->camera_from_object;
  Matrix6d h = at.hessian;
  Vector6d unused = Vector6d::Zero();
  const Coordinates coordinates(pose, axis);
  coordinates.rotate(&h, &unused);

  const int unknowns = axis.present ? 5 : 6;
  result->well_posed = fullRank(h);
  const double variance = at.variance(unknowns);
  if (variance > 0) h /= variance;
  if (axis.present) h(5, 5) = 1;

  Matrix6d inverse = result->well_posed ? Matrix6d(Eigen::LDLT<Matrix6d>(h).solve(Matrix6d::Identity()))
                                        : inverseWithPrior(h);
  if (variance == 0 && result->well_posed) inverse.setZero();  // exact matches

  if (axis.present) {
    inverse.row(5).setZero();
    inverse.col(5).setZero();
    inverse.rightCols<3>() = (inverse.rightCols<3>() * coordinates.rotation_axes.transpose()).eval();
    inverse.bottomRows<3>() = (coordinates.rotation_axes * inverse.bottomRows<3>()).eval();
    Vector6d spin;
    const Eigen::Vector3d free = coordinates.rotation_axes.col(2);
    spin << (pose.rotation * axis.point).cross(free), free;  // perturbed() moves about the object's origin
    inverse += kFreeVariance * spin * spin.transpose();
  }

  if (inverse.allFinite())
    result->covariance = 0.5 * (inverse + inverse.transpose());
  else
    result->well_posed = false;
}

}  // namespace

void RefineOptions::check() const {
  require(max_iterations >= 1 && max_iterations <= 10000, "max_iterations", max_iterations, "1 to 10000");
  require(robust_scale == 0 || robust_scale >= 1, "robust_scale", robust_scale,
          "0 (least squares) or at least 1");
  requireNotNegative("min_step", min_step);
}

RefinedPose refinePose(const Rigid3& start, const Camera& camera, const std::vector<LineMatch>& lines,
                       const std::vector<PointMatch>& points, const RefineOptions& options,
                       const FreeAxis& free_axis) {
  options.check();
  RefinedPose result;
  if (start.isFinite()) result.camera_from_object = start;
  if (!usable(start, camera, lines, points, free_axis)) return result;

  MatchResiduals residuals(camera, lines, points);
  residuals.evaluate(start);
  double scale = options.robust_scale > 0 ? residuals.scale() : 0;
  NormalEquations now = residuals.accumulate(options.robust_scale * scale), trial;
  double lambda = 1e-4;
  bool settled = scale <= 1;  // the cut-off stands
  Rigid3 pose = start;
  while (std::isfinite(now.cost) && now.residuals > 0 && result.iterations < options.max_iterations) {
    ++result.iterations;
    const Coordinates coordinates(pose, free_axis);
    Matrix6d h = now.hessian;
    Vector6d g = now.gradient, step;
    // The loss is flatter than its weights say, by mean psi' / mean w: steps as long as Newton's once it is
    // settled
    if (settled) h *= std::clamp(now.slope / now.weights, 0.5, 1.0);
    coordinates.rotate(&h, &g);
    if (!dampedStep(h, g, lambda, &step)) {
      lambda = std::max(1e-8, lambda * 10);
      continue;
    }
    const Rigid3 next = perturbed(pose, coordinates.back(step));
    residuals.evaluate(next);
    trial = residuals.accumulate(options.robust_scale * scale);
    const bool small = step.cwiseAbs().maxCoeff() < options.min_step;
    if (trial.cost <= now.cost) {
      pose = next;
      now = trial;
      lambda = std::max(1e-9, 0.1 * lambda);
      settled = true;
      if (scale > 1) {  // the cut-off comes down with the residuals
        const double tighter = std::min(scale, residuals.scale());
        if (tighter < 0.999 * scale) {
          settled = tighter > 0.98 * scale;
          scale = tighter;
          now = residuals.accumulate(options.robust_scale * scale);
          if (!small) continue;
        }
      }
    } else if (!small) {
      lambda = std::max(1e-4, 10 * lambda);
      if (lambda > 1e8) break;
      continue;
    }
    if (small) {
      result.converged = true;
      break;
    }
  }
  if (!std::isfinite(now.cost) || now.residuals == 0) return result;
  result.camera_from_object = {nearestRotation(pose.rotation), pose.translation};
  result.inliers = now.inliers;
  result.rms = now.rms();
  covarianceOf(now, free_axis, &result);
  return result;
}

double lineResidual(const Rigid3& pose, const Camera& camera, const LineMatch& match, Vector6d* derivative) {
  const Eigen::Vector3d rotated = pose.rotation * match.p_in_object, p = rotated + pose.translation;
  if (derivative) {
    const double z = 1 / p.z(), nx = match.normal.x() * camera.fx * z, ny = match.normal.y() * camera.fy * z;
    const Eigen::Vector3d a(nx, ny, -(nx * p.x() + ny * p.y()) * z);
    *derivative << a, rotated.cross(a);
  }
  return match.normal.dot(camera.project(p) - match.uv);
}

Eigen::Vector2d pointResidual(const Rigid3& pose, const Camera& camera, const PointMatch& match,
                              Eigen::Matrix<double, 2, 6>* derivative) {
  const Eigen::Vector3d rotated = pose.rotation * match.p_in_object, p = rotated + pose.translation;
  if (derivative) {
    const double z = 1 / p.z();
    const Eigen::Vector3d u(camera.fx * z, 0, -camera.fx * p.x() * z * z),
        v(0, camera.fy * z, -camera.fy * p.y() * z * z);
    derivative->row(0) << u.transpose(), rotated.cross(u).transpose();
    derivative->row(1) << v.transpose(), rotated.cross(v).transpose();
  }
  return camera.project(p) - match.uv;
}

}  // namespace monocular_eye_hand
