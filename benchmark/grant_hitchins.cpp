#include "grant_hitchins.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace monocular_eye_hand {
namespace {

using Complex = std::complex<double>;
using Polynomial = std::vector<double>;  // constant first

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

struct Value {
  Complex p, slope;
  double bound;  ///< of the rounding of |p|
};

/// Horner with Adams' running bound (CACM 10, 1967).
Value evaluate(const Polynomial& c, const Complex& z) {
  const double size = std::abs(z);
  Value v{c.back(), 0, 0.8 * std::abs(c.back())};
  for (size_t k = c.size() - 1; k-- > 0;) {
    v.slope = v.slope * z + v.p;
    v.p = v.p * z + c[k];
    v.bound = size * v.bound + std::abs(v.p);
  }
  v.bound *= 5 * kEpsilon;
  return v;
}

/// Schur's test: whether a root lies inside the unit circle.
bool rootInUnitCircle(Polynomial c) {
  while (c.size() > 1) {
    const double first = c.front(), last = c.back();
    if (!(std::abs(first) > std::abs(last))) return true;
    Polynomial next(c.size() - 1);
    for (size_t k = 0; k < next.size(); ++k) next[k] = first * c[k] - last * c[c.size() - 1 - k];
    const double largest = std::abs(*std::max_element(
        next.begin(), next.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    if (!(largest > 0)) return true;
    for (double& k : next) k /= largest;
    c = next;
  }
  return false;
}

/// Coefficients by powers of two: their geometric mean near 1.
void balance(Polynomial* c) {
  double sum = 0;
  int count = 0;
  for (const double k : *c)
    if (k != 0) {
      sum += std::log2(std::abs(k));
      ++count;
    }
  const int shift = -int(std::lround(sum / count));
  for (double& k : *c) k = std::ldexp(k, shift);
}

/// One root, of those inside the unit circle when there are any.
Complex search(const Polynomial& c) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    Complex z = attempt == 0 ? Complex(0.001, 0.1) : std::polar(0.3 + 0.1 * attempt, 0.7 + 1.3 * attempt);
    Value v = evaluate(c, z);
    for (int i = 0; i < 200; ++i) {
      if (std::abs(v.p) <= v.bound) return z;
      if (std::norm(v.slope) <= 1e-30 * std::norm(v.p)) break;  // a saddle point
      Complex step = -v.p / v.slope;
      double length = std::abs(step);
      if (length > 1) {
        step /= length;
        length = 1;
      }
      Value next = evaluate(c, z + step);
      while (std::norm(next.p) > (1 - 2e-4 * length) * std::norm(v.p) && length > kEpsilon * std::abs(z)) {
        step *= 0.5;
        length *= 0.5;
        next = evaluate(c, z + step);
      }
      if (std::norm(next.p) >= std::norm(v.p)) return z;  // no smaller value is to be had
      z += step;
      v = next;
    }
  }
  return 0;
}

/// c / divisor, from the high end and from the low end, joined where the two agree best. `divisor`: z^m + ..
/// with its constant first.
Polynomial deflate(const Polynomial& c, const Polynomial& divisor) {
  const size_t m = divisor.size() - 1, n = c.size() - m;
  Polynomial high(n), low(n);
  for (size_t k = n; k-- > 0;) {
    high[k] = c[k + m];
    for (size_t i = 0; i < m; ++i)
      if (k + m - i < n) high[k] -= divisor[i] * high[k + m - i];
  }
  for (size_t k = 0; k < n; ++k) {
    low[k] = c[k];
    for (size_t i = 1; i <= std::min(m, k); ++i) low[k] -= divisor[i] * low[k - i];
    low[k] /= divisor[0];
  }
  size_t join = 0;
  double best = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < n; ++k) {
    const double apart = std::abs(high[k] - low[k]) / (std::abs(high[k]) + std::abs(low[k]));
    if (apart < best) {
      best = apart;
      join = k;
    }
  }
  Polynomial quotient(n);
  for (size_t k = 0; k < n; ++k) quotient[k] = k < join ? low[k] : high[k];
  if (best < 1) quotient[join] = 0.5 * (high[join] + low[join]);
  return quotient;
}

void solveQuadratic(const Polynomial& c, double scale, std::vector<Complex>* roots) {
  if (c.size() == 2) {
    roots->push_back(-scale * c[0] / c[1]);
    return;
  }
  const double half = 0.5 * c[1], discriminant = half * half - c[0] * c[2];
  if (discriminant < 0) {
    const Complex root = scale * Complex(-half, std::sqrt(-discriminant)) / c[2];
    roots->push_back(root);
    roots->push_back(std::conj(root));
    return;
  }
  const double z = -(half + std::copysign(std::sqrt(discriminant), half));
  roots->push_back(z != 0 ? scale * c[0] / z : 0);
  roots->push_back(scale * z / c[2]);
}

}  // namespace

std::vector<Complex> grantHitchinsRoots(Polynomial c) {
  std::vector<Complex> roots;
  while (!c.empty() && c.back() == 0) c.pop_back();
  while (c.size() > 1 && c.front() == 0) {
    roots.push_back(0);
    c.erase(c.begin());
  }

  double scale = 1;
  while (c.size() > 3) {
    balance(&c);
    for (int i = 0; i < 60 && !rootInUnitCircle(c); ++i) {  // z = 2 z'
      scale *= 2;
      for (size_t k = 0; k < c.size(); ++k) c[k] = std::ldexp(c[k], int(k));
      balance(&c);
    }

    Complex z = search(c);
    if (std::abs(z.imag()) <= 0.1) {
      const Value real = evaluate(c, z.real());
      if (std::abs(real.p) <= real.bound) z = z.real();
    }
    roots.push_back(scale * z);
    if (z.imag() == 0) {
      c = deflate(c, {-z.real(), 1});
    } else {
      roots.push_back(std::conj(scale * z));
      c = deflate(c, {std::norm(z), -2 * z.real(), 1});
    }
  }

  if (c.size() > 1) solveQuadratic(c, scale, &roots);
  return roots;
}

}  // namespace monocular_eye_hand
