#include "p3p_reference.h"

#include <array>
#include <cmath>
#include <complex>

namespace monocular_eye_hand {
namespace {

using Long = long double;
using Complex = std::complex<Long>;
using Vector3l = Eigen::Matrix<Long, 3, 1>;

/// All roots of z^4 + c[3] z^3 + .. + c[0] at once.
std::array<Complex, 4> durandKerner(const std::array<Long, 4>& c) {
  std::array<Complex, 4> z;
  for (size_t i = 0; i < 4; ++i) z[i] = std::polar(Long(1.1), Long(0.4) + Long(1.5707) * Long(i));
  for (int iteration = 0; iteration < 400; ++iteration) {
    Long largest = 0;
    for (size_t i = 0; i < 4; ++i) {
      Complex slope = 1;
      for (size_t k = 0; k < 4; ++k)
        if (k != i) slope *= z[i] - z[k];
      const Complex step = ((((z[i] + c[3]) * z[i] + c[2]) * z[i] + c[1]) * z[i] + c[0]) / slope;
      z[i] -= step;
      largest = std::max(largest, std::abs(step) / (std::abs(z[i]) + Long(1e-30)));
    }
    if (largest < 1e-18L) break;
  }
  return z;
}

}  // namespace

int referenceCount(const P3PProblem& p) {
  const auto point = [&](int i) { return Vector3l(p.points.col(i).cast<Long>()); };
  const auto bearing = [&](int i) { return Vector3l(p.bearings.col(i).cast<Long>().normalized()); };
  // sides opposite to points 1, 2, 3 and cosines of the angles they are seen under
  const Long a2 = (point(1) - point(2)).squaredNorm(), b2 = (point(0) - point(2)).squaredNorm(),
             c2 = (point(0) - point(1)).squaredNorm();
  const Long alpha = bearing(1).dot(bearing(2)), beta = bearing(0).dot(bearing(2)),
             gamma = bearing(0).dot(bearing(1));
  const Long q = (a2 - c2) / b2, r = (a2 + c2) / b2;
  const Long A4 = (q - 1) * (q - 1) - 4 * c2 / b2 * alpha * alpha;
  const Long A3 = 4 * (q * (1 - q) * beta - (1 - r) * alpha * gamma + 2 * c2 / b2 * alpha * alpha * beta);
  const Long A2 = 2 * (q * q - 1 + 2 * q * q * beta * beta + 2 * (b2 - c2) / b2 * alpha * alpha -
                       4 * r * alpha * beta * gamma + 2 * (b2 - a2) / b2 * gamma * gamma);
  const Long A1 = 4 * (-q * (1 + q) * beta + 2 * a2 / b2 * gamma * gamma * beta - (1 - r) * alpha * gamma);
  const Long A0 = (1 + q) * (1 + q) - 4 * a2 / b2 * gamma * gamma;
  const auto roots = durandKerner({A0 / A4, A1 / A4, A2 / A4, A3 / A4});
  int count = 0;
  for (size_t i = 0; i < 4; ++i) {
    for (size_t k = 0; k < 4; ++k)
      if (k != i && std::abs(roots[i] - roots[k]) < 1e-6L * std::abs(roots[i])) return -1;
    if (std::abs(roots[i].imag()) > 1e-9L * std::abs(roots[i])) continue;
    const Long v = roots[i].real(), denominator = 2 * (gamma - v * alpha);
    if (std::abs(denominator) < 1e-12L) return -1;
    const Long u = ((q - 1) * v * v - 2 * q * beta * v + 1 + q) / denominator;
    if (std::abs(u) < 1e-9L || std::abs(v) < 1e-9L) return -1;
    count += u > 0 && v > 0;
  }
  return count;
}

}  // namespace monocular_eye_hand
