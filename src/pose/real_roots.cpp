#include "pose/real_roots.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

double at(const double* c, int degree, double x) {
  double value = c[degree];
  for (int i = degree - 1; i >= 0; --i) value = value * x + c[i];
  return value;
}

/// The root between ends of different sign: secant steps (Illinois), which cannot leave the bracket.
double bracketed(const double* c, int degree, double low, double high, double f_low, double f_high) {
  int side = 0;
  for (int i = 0; i < 200; ++i) {
    double x = (low * f_high - high * f_low) / (f_high - f_low);
    if (!(x > low && x < high)) x = 0.5 * (low + high);
    if (x <= low || x >= high || high - low < 1e-16) return x;
    const double f = at(c, degree, x);
    if (f == 0) return x;

    if ((f > 0) == (f_high > 0)) {
      high = x;
      f_high = f;
      if (side == 1) f_low *= 0.5;
      side = 1;
    } else {
      low = x;
      f_low = f;
      if (side == -1) f_high *= 0.5;
      side = -1;
    }
  }
  return 0.5 * (low + high);
}

/// Between neighbouring extrema, the derivative's roots, the polynomial is monotone: at most one root each.
RealRoots solve(const double* c, int degree, double low, double high) {
  RealRoots roots;
  if (degree == 0) return roots;

  double derivative[4] = {};
  for (int i = 1; i <= degree; ++i) derivative[i - 1] = i * c[i];
  const RealRoots extrema = solve(derivative, degree - 1, low, high);

  const double reach = std::max(std::abs(low), std::abs(high));
  double size = 0;
  for (int i = degree; i >= 0; --i) size = size * reach + std::abs(c[i]);
  const double touch = 1e-10 * size;  // lifted off the axis by rounding of the coefficients

  double x = low, f = at(c, degree, x);
  const auto keep = [&](double root) {
    if (roots.count < int(roots.at.size())) roots.at[roots.count++] = root;
  };
  bool kept_here = std::abs(f) <= touch;
  if (kept_here) keep(x);
  for (int i = 0; i <= extrema.count; ++i) {
    const double next = i < extrema.count ? extrema.at[i] : high;
    const double f_next = at(c, degree, next);
    if (f != 0 && f_next != 0 && (f > 0) != (f_next > 0)) keep(bracketed(c, degree, x, next, f, f_next));
    if (std::abs(f_next) <= touch && next > x) keep(next);
    x = next;
    f = f_next;
  }
  return roots;
}

}  // namespace

RealRoots realRoots(const Quartic& polynomial, double low, double high) {
  return solve(polynomial.data(), 4, low, high);
}

}  // namespace monocular_eye_hand
