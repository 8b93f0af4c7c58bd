#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "monocular_eye_hand/pose/p3p.h"
#include "monocular_eye_hand/pose/refine.h"

namespace monocular_eye_hand {
namespace {

struct Candidate {
  int index;
  Matrix6d information;
};

/// log det of the pose's information from the chosen points; -inf when they do not fix the pose. A weak
/// prior, far below any measurement, makes fewer than three points comparable.
double quality(const std::vector<Candidate>& all, const std::array<int, 4>& chosen, int count,
               const Vector6d& prior) {
  Matrix6d h = prior.asDiagonal();
  for (int i = 0; i < count; ++i) h += all[chosen[i]].information;
  const Eigen::LLT<Matrix6d> llt(h);
  if (llt.info() != Eigen::Success) return -INFINITY;
  return 2 * llt.matrixLLT().diagonal().array().log().sum();
}

bool contains(const std::array<int, 4>& chosen, int count, int i) {
  return std::find(chosen.begin(), chosen.begin() + count, i) != chosen.begin() + count;
}

double squaredError(const Rigid3& pose, const Camera& camera, const std::vector<PointMatch>& four) {
  double sum = 0;
  for (const PointMatch& m : four) {
    if (!((pose * m.p_in_object).z() > 0)) return INFINITY;
    sum += pointResidual(pose, camera, m).squaredNorm() / (m.sigma * m.sigma);
  }
  return sum;
}

}  // namespace

std::vector<int> bestFour(const std::vector<PointMatch>& points, const Rigid3& start, const Camera& camera) {
  std::vector<Candidate> all;
  Vector6d scale = Vector6d::Zero();
  for (size_t i = 0; i < points.size(); ++i) {
    const PointMatch& m = points[i];
    if (!m.p_in_object.allFinite() || !m.uv.allFinite() || !(m.sigma > 0) || !std::isfinite(m.sigma))
      continue;
    if (!((start * m.p_in_object).z() > 0)) continue;
    Eigen::Matrix<double, 2, 6> j;
    const Eigen::Vector2d r = pointResidual(start, camera, m, &j);
    const Matrix6d information = j.transpose() * j / (m.sigma * m.sigma + r.squaredNorm());
    if (!information.allFinite()) continue;
    scale = scale.cwiseMax(information.diagonal());
    all.push_back({int(i), information});
  }
  const int n = int(all.size());
  if (n < 4 || !(scale.minCoeff() > 0)) return {};
  const Vector6d prior = 1e-9 * scale;

  std::array<int, 4> chosen{};
  for (int count = 0; count < 4; ++count) {  // greedy, then exchanges while they help
    double best = -INFINITY;
    int next = -1;
    for (int i = 0; i < n; ++i) {
      if (contains(chosen, count, i)) continue;
      chosen[count] = i;
      const double q = quality(all, chosen, count + 1, prior);
      if (q > best) {
        best = q;
        next = i;
      }
    }
    if (next < 0) return {};
    chosen[count] = next;
  }
  double now = quality(all, chosen, 4, prior);
  for (bool better = true; better;) {
    better = false;
    for (int slot = 0; slot < 4; ++slot)
      for (int i = 0; i < n; ++i) {
        if (contains(chosen, 4, i)) continue;
        std::array<int, 4> other = chosen;
        other[slot] = i;
        const double q = quality(all, other, 4, prior);
        if (q > now + 1e-9) {
          now = q;
          chosen = other;
          better = true;
        }
      }
  }
  // Four that leave a direction to the prior fix no pose.
  Matrix6d h = Matrix6d::Zero();
  for (int i : chosen) h += all[i].information;
  const Vector6d s = h.diagonal().cwiseSqrt().cwiseInverse();
  if (!s.allFinite()) return {};
  const Eigen::LDLT<Matrix6d> ldlt(s.asDiagonal() * h * s.asDiagonal());
  if (ldlt.info() != Eigen::Success || !(ldlt.vectorD().minCoeff() > 1e-8)) return {};
  std::vector<int> indices;
  for (int i : chosen) indices.push_back(all[i].index);
  std::sort(indices.begin(), indices.end());
  return indices;
}

RefinedPose poseFromBestFour(const std::vector<PointMatch>& points, const Rigid3& start,
                             const Camera& camera) {
  std::vector<PointMatch> four;
  if (start.isFinite())
    for (int i : bestFour(points, start, camera)) four.push_back(points[i]);
  RefinedPose result;
  if (start.isFinite()) result.camera_from_object = start;
  if (four.empty()) return result;

  Rigid3 best = start;
  double best_error = squaredError(start, camera, four);
  for (int left_out = 0; left_out < 4; ++left_out) {
    Eigen::Matrix3d bearings, corners;
    for (int k = 0; k < 3; ++k) {
      const PointMatch& m = four[k < left_out ? k : k + 1];
      bearings.col(k) = camera.ray(m.uv).normalized();
      corners.col(k) = m.p_in_object;
    }
    const PoseSolutions poses = solveP3P(bearings, corners);
    const int i = chooseByFourthPoint(poses, four[left_out].p_in_object, camera.ray(four[left_out].uv));
    if (i < 0) continue;
    const double error = squaredError(poses.camera_from_object[i], camera, four);
    if (error < best_error) {
      best_error = error;
      best = poses.camera_from_object[i];
    }
  }

  RefineOptions options;
  options.robust_scale = 0;
  options.max_iterations = 20;
  return refinePose(best, camera, {}, four, options);
}

}  // namespace monocular_eye_hand
