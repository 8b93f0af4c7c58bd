#pragma once
#include <array>

namespace monocular_eye_hand {

/// Coefficients of 1, x, x^2, x^3, x^4.
using Quartic = std::array<double, 5>;

/// Real roots, ascending. A double root that rounding has lifted off the axis is returned once.
struct RealRoots {
  int count = 0;
  std::array<double, 8> at{};
  const double* begin() const { return at.data(); }
  const double* end() const { return at.data() + count; }
};
RealRoots realRoots(const Quartic& polynomial, double low, double high);

}  // namespace monocular_eye_hand
