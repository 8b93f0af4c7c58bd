#include "p3p_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace monocular_eye_hand {
namespace {

using Long = long double;
#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;
#else
using Quad = long double;  // 113 bits where there is no __float128
#endif

struct QuadComplex {
  Quad re, im;
};
QuadComplex operator-(const QuadComplex& a, const QuadComplex& b) { return {a.re - b.re, a.im - b.im}; }
QuadComplex operator*(const QuadComplex& a, const QuadComplex& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
QuadComplex operator/(const QuadComplex& a, const QuadComplex& b) {
  const Quad n = b.re * b.re + b.im * b.im;
  return {(a.re * b.re + a.im * b.im) / n, (a.im * b.re - a.re * b.im) / n};
}

using Roots = std::array<std::complex<Long>, 4>;
using QuadRoots = std::array<QuadComplex, 4>;

/// All roots of z^4 + c[3] z^3 + .. + c[0] at once, by Durand and Kerner.
Roots durandKerner(const std::array<Quad, 4>& coefficients) {
  std::array<Long, 4> c;
  for (size_t i = 0; i < 4; ++i) c[i] = Long(coefficients[i]);
  Roots z;
  for (size_t i = 0; i < 4; ++i) z[i] = std::polar(Long(1.1), Long(0.4) + Long(1.5707) * Long(i));
  for (int iteration = 0; iteration < 400; ++iteration) {
    Long largest = 0;
    for (size_t i = 0; i < 4; ++i) {
      std::complex<Long> slope = 1;
      for (size_t k = 0; k < 4; ++k)
        if (k != i) slope *= z[i] - z[k];
      const auto step = ((((z[i] + c[3]) * z[i] + c[2]) * z[i] + c[1]) * z[i] + c[0]) / slope;
      z[i] -= step;
      largest = std::max(largest, std::abs(step) / (std::abs(z[i]) + Long(1e-30)));
    }
    if (largest < 1e-17L) break;
  }
  return z;
}

/// The same iteration in four-fold precision, from there on: it squares the error.
QuadRoots sharpened(const Roots& start, const std::array<Quad, 4>& c) {
  QuadRoots z;
  for (size_t i = 0; i < 4; ++i) z[i] = {start[i].real(), start[i].imag()};
  for (int iteration = 0; iteration < 4; ++iteration)
    for (size_t i = 0; i < 4; ++i) {
      QuadComplex value = {1, 0}, slope = {1, 0};
      for (size_t k = 4; k-- > 0;) {
        value = value * z[i];
        value.re += c[k];
      }
      for (size_t k = 0; k < 4; ++k)
        if (k != i) slope = slope * (z[i] - z[k]);
      z[i] = z[i] - value / slope;
    }
  return z;
}

Quad squareRoot(Quad x) {
  const Quad s = std::sqrt(Long(x));
  return (s + x / s) / 2;
}

Quad squaredDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Quad sum = 0;
  for (int i = 0; i < 3; ++i) sum += (Quad(a[i]) - Quad(b[i])) * (Quad(a[i]) - Quad(b[i]));
  return sum;
}

Quad cosine(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Quad ab = 0, aa = 0, bb = 0;
  for (int i = 0; i < 3; ++i) {
    ab += Quad(a[i]) * Quad(b[i]);
    aa += Quad(a[i]) * Quad(a[i]);
    bb += Quad(b[i]) * Quad(b[i]);
  }
  return ab / squareRoot(aa * bb);
}

Long size(const QuadComplex& z) { return std::hypot(Long(z.re), Long(z.im)); }

}  // namespace

int referenceCount(const P3PProblem& p) {
  // squared sides opposite to points 1, 2, 3 and cosines of the angles they are seen under
  const Quad a2 = squaredDistance(p.points.col(1), p.points.col(2)),
             b2 = squaredDistance(p.points.col(0), p.points.col(2)),
             c2 = squaredDistance(p.points.col(0), p.points.col(1));
  const Quad alpha = cosine(p.bearings.col(1), p.bearings.col(2)),
             beta = cosine(p.bearings.col(0), p.bearings.col(2)),
             gamma = cosine(p.bearings.col(0), p.bearings.col(1));

  const Quad q = (a2 - c2) / b2, r = (a2 + c2) / b2;
  const Quad k4 = (q - 1) * (q - 1) - 4 * c2 / b2 * alpha * alpha;
  const Quad k3 = 4 * (q * (1 - q) * beta - (1 - r) * alpha * gamma + 2 * c2 / b2 * alpha * alpha * beta);
  const Quad k2 = 2 * (q * q - 1 + 2 * q * q * beta * beta + 2 * (b2 - c2) / b2 * alpha * alpha -
                       4 * r * alpha * beta * gamma + 2 * (b2 - a2) / b2 * gamma * gamma);
  const Quad k1 = 4 * (-q * (1 + q) * beta + 2 * a2 / b2 * gamma * gamma * beta - (1 - r) * alpha * gamma);
  const Quad k0 = (1 + q) * (1 + q) - 4 * a2 / b2 * gamma * gamma;
  const std::array<Quad, 4> monic = {k0 / k4, k1 / k4, k2 / k4, k3 / k4};
  const QuadRoots roots = sharpened(durandKerner(monic), monic);

  int count = 0;
  for (size_t i = 0; i < 4; ++i) {
    for (size_t k = 0; k < 4; ++k)
      if (k != i && !(size(roots[i] - roots[k]) > 1e-6L * size(roots[i]))) return -1;
    if (std::abs(Long(roots[i].im)) > 1e-15L * size(roots[i])) continue;
    const Quad v = roots[i].re, denominator = 2 * (gamma - v * alpha);
    if (std::abs(Long(denominator)) < 1e-12L) return -1;
    const Quad u = ((q - 1) * v * v - 2 * q * beta * v + 1 + q) / denominator;
    if (std::abs(Long(u)) < 1e-9L || std::abs(Long(v)) < 1e-9L) return -1;
    count += u > 0 && v > 0;
  }
  return count;
}

}  // namespace monocular_eye_hand
