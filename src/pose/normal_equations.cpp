#include "pose/normal_equations.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "monocular_eye_hand/geometry/median.h"

namespace monocular_eye_hand {
namespace {

constexpr double kNearest = 1e-9;  // [m] in front of the lens

/// Upper triangle of h += w j j^T, g += w r j.
inline void add(double w, double r, const Eigen::Vector3d& a, const Eigen::Vector3d& rotated, double* h,
                double* g) {
  const double j[6] = {a.x(),
                       a.y(),
                       a.z(),
                       rotated.y() * a.z() - rotated.z() * a.y(),
                       rotated.z() * a.x() - rotated.x() * a.z(),
                       rotated.x() * a.y() - rotated.y() * a.x()};
  int k = 0;
  for (int i = 0; i < 6; ++i) {
    const double wj = w * j[i];
    g[i] += wj * r;
    for (int m = i; m < 6; ++m) h[k++] += wj * j[m];
  }
}

}  // namespace

double NormalEquations::rms() const { return weights > 0 ? std::sqrt(square_px / weights) : 0; }

double NormalEquations::variance(int unknowns) const {
  if (residuals <= unknowns || !(slope > 0)) return 1;
  const double n = residuals, mean = slope / n;
  const double correction = 1 + unknowns / n * (1 - mean) / mean;
  // weights stand here because the hessian holds w J^T J rather than J^T J
  return correction * correction * influence * weights / (slope * slope) * n / (n - unknowns);
}

MatchResiduals::MatchResiduals(const Camera& camera, const std::vector<LineMatch>& lines,
                               const std::vector<PointMatch>& points)
    : camera_(camera), lines_(lines), points_(points), rows_(lines.size() + points.size()) {
  sizes_.reserve(rows_.size());
}

void MatchResiduals::evaluate(const Rigid3& pose) {
  const double fx = camera_.fx, fy = camera_.fy;
  size_t k = 0;
  for (const LineMatch& m : lines_) {
    Row& row = rows_[k++];
    row.rotated.noalias() = pose.rotation * m.p_in_object;
    const Eigen::Vector3d p = row.rotated + pose.translation;
    if (!(p.z() > kNearest)) {
      row.square = -1;
      continue;
    }
    const double z = 1 / p.z(), s = 1 / m.sigma, x = p.x() * z, y = p.y() * z;
    const double nx = m.normal.x() * s, ny = m.normal.y() * s;
    row.r0 = nx * (fx * x + camera_.cx - m.uv.x()) + ny * (fy * y + camera_.cy - m.uv.y());
    const double ax = nx * fx * z, ay = ny * fy * z;
    row.a0 = {ax, ay, -(ax * x + ay * y)};
    row.square = row.r0 * row.r0;
  }

  for (const PointMatch& m : points_) {
    Row& row = rows_[k++];
    row.rotated.noalias() = pose.rotation * m.p_in_object;
    const Eigen::Vector3d p = row.rotated + pose.translation;
    if (!(p.z() > kNearest)) {
      row.square = -1;
      continue;
    }
    const double z = 1 / p.z(), s = 1 / m.sigma, x = p.x() * z, y = p.y() * z;
    row.r0 = s * (fx * x + camera_.cx - m.uv.x());
    row.r1 = s * (fy * y + camera_.cy - m.uv.y());
    row.a0 = {s * fx * z, 0, -s * fx * z * x};
    row.a1 = {0, s * fy * z, -s * fy * z * y};
    row.square = row.r0 * row.r0 + row.r1 * row.r1;
  }
}

double MatchResiduals::scale() {
  sizes_.clear();
  // Over the median of a normal residual's square, of one or two dimensions.
  for (size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].square >= 0) sizes_.push_back(rows_[i].square * (i < lines_.size() ? 2.1981 : 0.7213));
  if (sizes_.empty()) return 1;
  return std::max(1.0, std::sqrt(median(&sizes_)));
}

NormalEquations MatchResiduals::accumulate(double cut) const {
  NormalEquations sum;
  double h[21] = {}, g[6] = {};
  const double inverse = cut > 0 ? 1 / (cut * cut) : 0, max_cost = cut * cut / 6;
  for (size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const bool is_line = i < lines_.size();
    const double u = row.square * inverse;
    if (row.square < 0 || u >= 1) {
      sum.cost += cut > 0 ? max_cost : std::numeric_limits<double>::infinity();
      continue;
    }

    const double v = 1 - u, w = v * v;
    sum.cost += cut > 0 ? max_cost * (1 - w * v) : 0.5 * row.square;
    add(w, row.r0, row.a0, row.rotated, h, g);
    if (!is_line) add(w, row.r1, row.a1, row.rotated, h, g);

    const int dimension = is_line ? 1 : 2;
    const double sigma = is_line ? lines_[i].sigma : points_[i - lines_.size()].sigma;
    sum.residuals += dimension;
    sum.inliers += w;
    sum.weights += dimension * w;
    sum.influence += w * w * row.square;
    sum.slope += dimension * w - 4 * u * v;
    sum.square_px += w * row.square * sigma * sigma;
  }

  int k = 0;
  for (int i = 0; i < 6; ++i) {
    sum.gradient[i] = g[i];
    for (int m = i; m < 6; ++m) sum.hessian(i, m) = sum.hessian(m, i) = h[k++];
  }
  return sum;
}

}  // namespace monocular_eye_hand
