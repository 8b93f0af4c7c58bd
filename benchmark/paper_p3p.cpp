#include "paper_p3p.h"

#include <Eigen/LU>
#include <cmath>

#include "grant_hitchins.h"
#include "monocular_eye_hand/pose/p3p.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Sides and cosines of the tetrahedron over the points a, b, c.
struct Tetrahedron {
  double ab2, ac2, bc2;  // squared sides
  double cab, cac, cbc;  // cosines of the angles between the legs
};

/// Fischler & Bolles' quartic in x = |b| / |a|, constant first.
std::vector<double> quarticOf(const Tetrahedron& t) {
  const double k1 = t.bc2 / t.ac2, k2 = t.bc2 / t.ab2, cab = t.cab, cac = t.cac, cbc = t.cbc;
  const double minus = k1 * k2 - k1 - k2, plus = k1 * k2 + k1 - k2;
  const double g4 = minus * minus - 4 * k1 * k2 * cbc * cbc;
  const double g3 =
      4 * minus * k2 * (1 - k1) * cab + 4 * k1 * cbc * ((k1 * k2 + k2 - k1) * cac + 2 * k2 * cab * cbc);
  const double g2 =
      4 * k2 * k2 * (1 - k1) * (1 - k1) * cab * cab + 2 * plus * minus +
      4 * k1 * ((k1 - k2) * cbc * cbc + (1 - k2) * k1 * cac * cac - 2 * k2 * (1 + k1) * cab * cac * cbc);
  const double g1 = 4 * plus * k2 * (1 - k1) * cab +
                    4 * k1 * ((k1 * k2 - k1 + k2) * cac * cbc + 2 * k1 * k2 * cab * cac * cac);
  const double g0 = plus * plus - 4 * k1 * k1 * k2 * cac * cac;
  return {g0, g1, g2, g3, g4};
}

/// Legs at a root x: y = |c| / |a| from the difference of the two quadratics, which is linear in y.
bool legsAt(const Tetrahedron& t, double x, Vector3d* legs) {
  const double k1 = t.bc2 / t.ac2, k2 = t.bc2 / t.ab2;
  // (1 - k1) y^2 + 2 (k1 cac - x cbc) y + x^2 - k1 = 0;  y^2 - 2 x cbc y + x^2 (1 - k2) + 2 x k2 cab - k2 = 0
  const double linear = 2 * (k1 * t.cac - x * t.cbc) + 2 * (1 - k1) * x * t.cbc;
  const double constant = x * x - k1 - (1 - k1) * (x * x * (1 - k2) + 2 * x * k2 * t.cab - k2);
  if (linear == 0) return false;
  const double y = -constant / linear, square = x * x - 2 * x * t.cab + 1;
  if (!(square > 0 && x > 0 && y > 0)) return false;
  const double a = std::sqrt(t.ab2 / square);
  *legs = Vector3d(a, x * a, y * a);
  return legs->allFinite();
}

void polishLegs(const Tetrahedron& t, Vector3d* legs) {
  for (int i = 0; i < 20; ++i) {
    const double a = (*legs)[0], b = (*legs)[1], c = (*legs)[2];
    const Vector3d r(a * a + b * b - 2 * a * b * t.cab - t.ab2, a * a + c * c - 2 * a * c * t.cac - t.ac2,
                     b * b + c * c - 2 * b * c * t.cbc - t.bc2);
    Matrix3d jacobian;
    jacobian << a - b * t.cab, b - a * t.cab, 0, a - c * t.cac, 0, c - a * t.cac, 0, b - c * t.cbc,
        c - b * t.cbc;
    const Vector3d step = 0.5 * (jacobian.inverse() * r);
    if (!step.allFinite()) return;
    *legs -= step;
    if (step.norm() < 1e-15 * legs->norm()) return;
  }
}

}  // namespace

std::vector<Rigid3> paperP3P(const P3PProblem& p, bool polish) {
  const Tetrahedron t = {
      (p.points.col(0) - p.points.col(1)).squaredNorm(), (p.points.col(0) - p.points.col(2)).squaredNorm(),
      (p.points.col(1) - p.points.col(2)).squaredNorm(), p.bearings.col(0).dot(p.bearings.col(1)),
      p.bearings.col(0).dot(p.bearings.col(2)),          p.bearings.col(1).dot(p.bearings.col(2))};
  std::vector<Rigid3> poses;
  for (const std::complex<double>& root : grantHitchinsRoots(quarticOf(t))) {
    Vector3d legs;
    if (root.imag() != 0 || !legsAt(t, root.real(), &legs)) continue;
    if (polish) polishLegs(t, &legs);
    poses.push_back(objectFromCamera(p.points, p.bearings * legs.asDiagonal()).inverse());
  }
  return poses;
}

}  // namespace monocular_eye_hand
