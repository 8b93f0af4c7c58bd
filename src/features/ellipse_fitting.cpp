#include "features/ellipse_fitting.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "features/ellipse_sums.h"

namespace monocular_eye_hand {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

// L D L^T of a symmetric positive definite matrix; small enough to unroll.
class Cholesky5 {
 public:
  explicit Cholesky5(const Matrix5d& m) {
    for (int i = 0; i < 5; ++i) {
      double pivot = m(i, i), scaled[5];  // row of L D
      for (int j = 0; j < i; ++j) {
        scaled[j] = m(i, j);
        for (int k = 0; k < j; ++k) scaled[j] -= scaled[k] * l_[j][k];
        l_[i][j] = scaled[j] * inverse_[j];
        pivot -= scaled[j] * l_[i][j];
      }
      positive_ = positive_ && pivot > 0;
      inverse_[i] = 1 / pivot;
    }
  }
  bool positive() const { return positive_; }
  Vector5d solve(Vector5d v) const {
    for (int i = 1; i < 5; ++i)
      for (int k = 0; k < i; ++k) v[i] -= l_[i][k] * v[k];
    for (int i = 4; i >= 0; --i) {
      v[i] *= inverse_[i];
      for (int k = i + 1; k < 5; ++k) v[i] -= l_[k][i] * v[k];
    }
    return v;
  }

 private:
  double l_[5][5], inverse_[5];  // below the diagonal; inverse of D
  bool positive_ = true;
};

// Eigenvalues of a matrix known to have three real ones (roots of its characteristic polynomial, Viete).
std::array<double, 3> realEigenvalues(const Eigen::Matrix3d& m) {
  const double third = m.trace() / 3;
  const Eigen::Matrix3d k = m - third * Eigen::Matrix3d::Identity();
  const double p = (k * k).trace() / 6, q = k.determinant() / 2;  // x^3 - 3 p x - 2 q = 0
  const double root = std::sqrt(std::max(p, 0.0));
  const double cosine = root > 0 ? q / (root * root * root) : 1.0;
  const double angle = std::acos(std::min(1.0, std::max(-1.0, cosine))) / 3;
  return {third + 2 * root * std::cos(angle), third + 2 * root * std::cos(angle - 2 * M_PI / 3),
          third + 2 * root * std::cos(angle + 2 * M_PI / 3)};
}

// The vector that a matrix of rank two takes to zero: the longest cross product of two of its rows.
Eigen::Vector3d nullVector(const Eigen::Matrix3d& m) {
  const Eigen::Vector3d r0 = m.row(0), r1 = m.row(1), r2 = m.row(2);
  Eigen::Vector3d best = r0.cross(r1);
  for (const Eigen::Vector3d& v : {Eigen::Vector3d(r1.cross(r2)), Eigen::Vector3d(r2.cross(r0))})
    if (v.squaredNorm() > best.squaredNorm()) best = v;
  return best.normalized();
}

bool reached(const EllipseFit& fit, const FitGoal& goal) {
  return std::isfinite(goal.chi2) && fit.rms <= goal.rms && fit.chi2 < goal.chi2;
}

// `gain` is how much less chi2 the next step promises.
constexpr double kTrust = 1.5;  // 2.5 finds hardly more ellipses and takes 3 % more instructions on texture
bool hopeless(const EllipseFit& fit, const FitGoal& goal, double gain) {
  const double left = fit.chi2 - kTrust * gain;
  return left > goal.chi2 || fit.rms * fit.rms * left > goal.rms * goal.rms * fit.chi2;
}

constexpr double kSettledGain = 1e-2;                  // of chi2: a step of a tenth of the standard deviation
constexpr double kFirstReach = 0.3, kMinReach = 1e-3;  // of a step, in shares of the minor axis

// A circle has no angle: keep it where it is instead of dividing by nothing, as if the angle were known to
// one radian.
void stabilize(Matrix5d* h) {
  for (int k = 0; k < 5; ++k) (*h)(k, k) += 1e-6 * (*h)(k, k) + 1e-9;
  (*h)(4, 4) += 1.0;
}

// NaN when the equations have no minimum.
Vector5d gaussNewtonStep(const EllipseNormalEquations& equations) {
  Matrix5d h = equations.h;
  stabilize(&h);
  const Cholesky5 cholesky(h);
  if (!cholesky.positive()) return Vector5d::Constant(std::nan(""));
  return cholesky.solve(equations.g);
}

void normalize(Ellipse* e) {
  if (e->b > e->a) {
    std::swap(e->a, e->b);
    e->angle += M_PI / 2;
  }
  e->angle -= M_PI * std::floor(e->angle / M_PI + 0.5);
}

double lengthOf(const Vector5d& step, const Ellipse& e) { return step.head<4>().cwiseAbs().maxCoeff() / e.b; }

// A bad start must not throw the ellipse inside out. False when nothing is left of it.
bool moved(const Ellipse& from, Vector5d step, double reach, Ellipse* to) {
  const double length = lengthOf(step, from);
  if (length > reach) step *= reach / length;
  step[4] = std::min(reach, std::max(-reach, step[4]));
  to->centre = from.centre - step.head<2>();
  to->a = from.a - step[2];
  to->b = from.b - step[3];
  to->angle = from.angle - step[4];
  if (!(to->b > 0.2 && to->a > 0.2)) return false;
  normalize(to);
  return true;
}

}  // namespace

EllipseFit fitEllipseDirect(const FitPoints& points) {
  EllipseFit fit;
  if (points.count() < 6) return fit;
  const ScatterMatrices s = scatterMatrices(points);
  if (!(s.scale > 1e-6)) return fit;
  const Eigen::Matrix3d t = -s.linear.inverse() * s.mixed.transpose();
  if (!t.allFinite()) return fit;

  const Eigen::Matrix3d m = s.quadratic + s.mixed * t;
  Eigen::Matrix3d reduced;  // inverse of the constraint matrix times m
  reduced << m.row(2) / 2, -m.row(1), m.row(0) / 2;

  for (const double eigenvalue : realEigenvalues(reduced)) {
    const Eigen::Vector3d a = nullVector(reduced - eigenvalue * Eigen::Matrix3d::Identity());
    if (!(4 * a[0] * a[2] - a[1] * a[1] > 0)) continue;
    const Eigen::Vector3d l = t * a;
    Eigen::Matrix3d conic;
    conic << a[0], a[1] / 2, l[0] / 2, a[1] / 2, a[2], l[1] / 2, l[0] / 2, l[1] / 2, l[2];
    const EllipseFromConic found = ellipseFromConic(conic);
    if (!found.valid) continue;
    fit.ellipse = found.ellipse;
    fit.ellipse.centre = s.mean + s.scale * found.ellipse.centre;
    fit.ellipse.a *= s.scale;
    fit.ellipse.b *= s.scale;
    fit.valid = true;
    fit.count = points.count();
  }
  return fit;
}

EllipseFit refineEllipse(const FitPoints& points, const Ellipse& start, int iterations, const FitGoal& goal) {
  EllipseFit fit;
  fit.ellipse = start;
  const int n = points.count();
  if (n < 6) return fit;

  EllipseNormalEquations equations;
  Vector5d step;
  Ellipse trial = start;
  double reach = kFirstReach;
  for (int it = 0; it <= iterations; ++it) {
    // Residuals larger than predicted (start not yet good, real edges not quite elliptic) widen the robust
    // scale.
    const double scale = it == 0 ? 3.0 : std::max(1.0, std::sqrt(fit.chi2 / std::max(1, n - 5)));
    const EllipseNormalEquations there = normalEquations(points, trial, scale);
    if (it == 0 || there.chi2 < fit.chi2) {
      equations = there;
      fit.ellipse = trial;
      fit.chi2 = there.chi2;
      fit.rms = std::sqrt(there.squares / n);
      fit.count = n;
      step = gaussNewtonStep(equations);
      if (!step.allFinite()) return fit;
      const double gain = equations.g.dot(step);
      if (reached(fit, goal) || hopeless(fit, goal, gain)) {
        fit.valid = true;
        return fit;
      }
      if (it > 0 && gain < kSettledGain * scale * scale) break;
      if (it > 0) reach = std::min(kFirstReach, 2 * reach);
    } else {
      reach = 0.25 * std::min(reach, lengthOf(step, fit.ellipse));
      if (reach < kMinReach) break;
    }
    if (it < iterations && !moved(fit.ellipse, step, reach, &trial)) return fit;
  }

  fit.information = equations.h;
  stabilize(&fit.information);
  fit.valid = std::isfinite(fit.ellipse.a) && Cholesky5(fit.information).positive();
  return fit;
}

Matrix5d covarianceOf(const EllipseFit& fit) {
  const Cholesky5 cholesky(fit.information);
  Matrix5d m;
  for (int k = 0; k < 5; ++k) m.col(k) = cholesky.solve(Vector5d::Unit(k));
  return 0.5 * (m + m.transpose());
}

}  // namespace monocular_eye_hand
