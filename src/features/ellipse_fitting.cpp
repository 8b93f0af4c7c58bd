#include "monocular_eye_hand/features/ellipse_fitting.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "monocular_eye_hand/features/line_fitting.h"

namespace monocular_eye_hand {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

// Calls use(point) for at most about max_points points, evenly chosen.
template <class Use>
void forPoints(const std::vector<EdgePoint>& points, const std::vector<PointRange>& ranges, int max_points,
               const Use& use) {
  int total = 0;
  for (const PointRange& r : ranges) total += r.count;
  const int stride = std::max(1, (total + max_points - 1) / max_points);
  for (const PointRange& r : ranges)
    for (int i = (r.count % stride) / 2; i < r.count; i += stride) use(points[r.first + i]);
}

// Local quantities at a point in the ellipse's own axes.
struct Local {
  double x, y;       // point
  double gx, gy, g;  // gradient of F = x^2/a^2 + y^2/b^2 - 1 and its length
  double f;
};
Local localAt(const Ellipse& e, double c, double s, const Eigen::Vector2d& uv) {
  const Eigen::Vector2d d = uv - e.centre;
  Local l;
  l.x = c * d.x() + s * d.y();
  l.y = -s * d.x() + c * d.y();
  const double ia = 1 / (e.a * e.a), ib = 1 / (e.b * e.b);
  l.f = l.x * l.x * ia + l.y * l.y * ib - 1;
  l.gx = 2 * l.x * ia;
  l.gy = 2 * l.y * ib;
  l.g = std::max(1e-9, std::sqrt(l.gx * l.gx + l.gy * l.gy));
  return l;
}

Vector5d jacobianAt(const Ellipse& e, double c, double s, const Local& l) {
  Vector5d j;
  const double nx = l.gx / l.g, ny = l.gy / l.g;
  j << -(c * nx - s * ny), -(s * nx + c * ny), -l.gx * l.x / (e.a * l.g), -l.gy * l.y / (e.b * l.g),
      (l.gx * l.y - l.gy * l.x) / l.g;
  return j;
}

// Curvature of the ellipse where the point projects to (along the ray from the centre).
double curvatureAt(const Ellipse& e, const Local& l) {
  const double x = l.x / e.a, y = l.y / e.b, r2 = std::max(1e-18, x * x + y * y);
  const double q = (e.a * e.a * y * y + e.b * e.b * x * x) / r2;
  return e.a * e.b / (q * std::sqrt(q));
}

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

void normalize(Ellipse* e) {
  if (e->b > e->a) {
    std::swap(e->a, e->b);
    e->angle += M_PI / 2;
  }
  e->angle -= M_PI * std::floor(e->angle / M_PI + 0.5);
}

}  // namespace

EllipseFit fitEllipseDirect(const std::vector<EdgePoint>& points, const std::vector<PointRange>& ranges,
                            int max_points) {
  EllipseFit fit;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double spread = 0;
  int n = 0;
  forPoints(points, ranges, max_points, [&](const EdgePoint& p) { mean += p.uv.cast<double>(), ++n; });
  if (n < 6) return fit;
  mean /= n;
  forPoints(points, ranges, max_points,
            [&](const EdgePoint& p) { spread += (p.uv.cast<double>() - mean).squaredNorm(); });
  const double scale = std::sqrt(spread / n);
  if (!(scale > 1e-6)) return fit;
  Eigen::Matrix3d s1 = Eigen::Matrix3d::Zero(), s2 = s1, s3 = s1;
  forPoints(points, ranges, max_points, [&](const EdgePoint& p) {
    const Eigen::Vector2d q = (p.uv.cast<double>() - mean) / scale;
    const Eigen::Vector3d quadratic(q.x() * q.x(), q.x() * q.y(), q.y() * q.y()), linear(q.x(), q.y(), 1);
    s1 += quadratic * quadratic.transpose();
    s2 += quadratic * linear.transpose();
    s3 += linear * linear.transpose();
  });
  const Eigen::Matrix3d t = -s3.inverse() * s2.transpose();
  if (!t.allFinite()) return fit;
  const Eigen::Matrix3d m = s1 + s2 * t;
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
    fit.ellipse.centre = mean + scale * found.ellipse.centre;
    fit.ellipse.a *= scale;
    fit.ellipse.b *= scale;
    fit.valid = true;
    fit.count = n;
  }
  return fit;
}

EllipseFit refineEllipse(const std::vector<EdgePoint>& points, const std::vector<PointRange>& ranges,
                         const Ellipse& start, int max_points, int iterations) {
  constexpr double kTukey = 4.0;  // standard deviations
  EllipseFit fit;
  fit.ellipse = start;
  for (int it = 0; it <= iterations; ++it) {
    const Ellipse e = fit.ellipse;
    const double c = std::cos(e.angle), s = std::sin(e.angle);
    Matrix5d h = Matrix5d::Zero();
    Vector5d g = Vector5d::Zero();
    double chi2 = 0, squares = 0;
    int n = 0;
    // Residuals larger than predicted (start not yet good, real edges not quite elliptic) widen the robust
    // scale.
    const double scale = it == 0 ? 3.0 : std::max(1.0, std::sqrt(fit.chi2 / std::max(1, fit.count - 5)));
    forPoints(points, ranges, max_points, [&](const EdgePoint& p) {
      const Local l = localAt(e, c, s, p.uv.cast<double>());
      const double inward = std::min(0.5, 0.5 * p.blur * p.blur * curvatureAt(e, l));
      const double r = l.f / l.g + inward;
      const double sigma = fitSigma(p), w = 1 / (sigma * sigma);
      const double u = r / (kTukey * scale * sigma);
      const double robust = u * u < 1 ? (1 - u * u) * (1 - u * u) : 0;
      const Vector5d j = jacobianAt(e, c, s, l);
      h += (w * robust) * (j * j.transpose());
      g += (w * robust * r) * j;
      chi2 += std::min(r * r * w, 9 * scale * scale);
      squares += r * r;
      ++n;
    });
    if (n < 6) return fit;
    fit.chi2 = chi2;
    fit.rms = std::sqrt(squares / n);
    fit.count = n;
    // A circle has no angle: keep it where it is instead of dividing by nothing.
    Matrix5d damped = h;
    for (int k = 0; k < 5; ++k) damped(k, k) += 1e-6 * h(k, k) + 1e-9;
    damped(4, 4) += 1.0;  // as if the angle were known to one radian
    const Eigen::LDLT<Matrix5d> ldlt(damped);
    if (it == iterations) {
      fit.covariance = ldlt.solve(Matrix5d::Identity());
      break;
    }
    Vector5d step = ldlt.solve(g);
    if (!step.allFinite()) return fit;
    const double most = 0.3 * e.b;  // a bad start must not throw the ellipse inside out
    const double length = step.head<4>().cwiseAbs().maxCoeff();
    if (length > most) step *= most / length;
    step[4] = std::min(0.3, std::max(-0.3, step[4]));
    fit.ellipse.centre -= step.head<2>();
    fit.ellipse.a -= step[2];
    fit.ellipse.b -= step[3];
    fit.ellipse.angle -= step[4];
    if (!(fit.ellipse.b > 0.2 && fit.ellipse.a > 0.2)) return fit;
    normalize(&fit.ellipse);
    if (length < 1e-4 && it + 1 < iterations) it = iterations - 1;
  }
  const double worst = fit.covariance.diagonal().minCoeff();
  fit.valid = fit.covariance.allFinite() && worst > 0 && std::isfinite(fit.ellipse.a);
  return fit;
}

EllipseDistance distanceTo(const Ellipse& e, const Eigen::Vector2d& uv) {
  const double c = std::cos(e.angle), s = std::sin(e.angle);
  const Local l = localAt(e, c, s, uv);
  return {l.f / l.g, {(c * l.gx - s * l.gy) / l.g, (s * l.gx + c * l.gy) / l.g}};
}

Eigen::Matrix<double, 1, 5> distanceJacobian(const Ellipse& e, const Eigen::Vector2d& uv) {
  const double c = std::cos(e.angle), s = std::sin(e.angle);
  return jacobianAt(e, c, s, localAt(e, c, s, uv)).transpose();
}

double eccentricAngle(const Ellipse& e, const Eigen::Vector2d& uv) {
  const double c = std::cos(e.angle), s = std::sin(e.angle);
  const Eigen::Vector2d d = uv - e.centre;
  return std::atan2((-s * d.x() + c * d.y()) / e.b, (c * d.x() + s * d.y()) / e.a);
}

double circumference(const Ellipse& e) {
  const double h = (e.a - e.b) * (e.a - e.b) / ((e.a + e.b) * (e.a + e.b));
  return M_PI * (e.a + e.b) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
}

}  // namespace monocular_eye_hand
