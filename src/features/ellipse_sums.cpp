#include "ellipse_sums.h"

#include <algorithm>
#include <cmath>

#include "vector_clones.h"

namespace monocular_eye_hand {
namespace {

constexpr int kLanes = FitPoints::kLanes;
constexpr int kBlock = 64;      // points whose columns stay in the cache together
constexpr double kTukey = 4.0;  // standard deviations

// Sum of products in kLanes interleaved parts: the order of the additions does not depend on the vector
// width.
MONOCULAR_EYE_HAND_INLINE double dot(const double* a, const double* b, int n) {
  double part[kLanes] = {};
  for (int i = 0; i < n; i += kLanes)
    for (int k = 0; k < kLanes; ++k) part[k] += a[i + k] * b[i + k];
  return (part[0] + part[1]) + (part[2] + part[3]);
}
MONOCULAR_EYE_HAND_INLINE double sum(const double* a, int n) {
  double part[kLanes] = {};
  for (int i = 0; i < n; i += kLanes)
    for (int k = 0; k < kLanes; ++k) part[k] += a[i + k];
  return (part[0] + part[1]) + (part[2] + part[3]);
}

// Columns over a block of points.
struct Block {
  alignas(32) double jacobian[5][kBlock], weighted[5][kBlock];
  alignas(32) double residual[kBlock], cost[kBlock];
};

struct Axes {
  double u, v, c, s, a, b;
};

MONOCULAR_EYE_HAND_INLINE void fillBlock(const double* x, const double* y, const double* weight,
                                         const double* blur2, int n, const Axes& e, double robust_scale,
                                         Block* block) {
  const double ia = 1 / (e.a * e.a), ib = 1 / (e.b * e.b), inverse_a = 1 / e.a, inverse_b = 1 / e.b;
  const double a2 = e.a * e.a, b2 = e.b * e.b, ab = e.a * e.b;
  const double tukey = 1 / (kTukey * kTukey * robust_scale * robust_scale);
  const double most = 9 * robust_scale * robust_scale;
  for (int i = 0; i < n; ++i) {
    const double du = x[i] - e.u, dv = y[i] - e.v;
    const double px = e.c * du + e.s * dv, py = e.c * dv - e.s * du;  // in the ellipse's own axes
    const double xx = px * px * ia, yy = py * py * ib;
    // F = x^2 / a^2 + y^2 / b^2 - 1 and its gradient.
    const double f = xx + yy - 1, gx = 2 * px * ia, gy = 2 * py * ib;
    const double inverse_g = 1 / std::max(1e-9, std::sqrt(gx * gx + gy * gy));
    const double nx = gx * inverse_g, ny = gy * inverse_g;
    // Curvature where the ray from the centre through the point meets the ellipse: a b / q^(3/2).
    const double q = (a2 * yy + b2 * xx) / std::max(1e-18, xx + yy);
    const double inward = std::min(0.5, 0.5 * blur2[i] * ab / (q * std::sqrt(q)));
    const double r = f * inverse_g + inward, chi2 = r * r * weight[i];
    const double inside = std::max(0.0, 1 - chi2 * tukey), robust = weight[i] * inside * inside;
    const double j0 = e.s * ny - e.c * nx, j1 = -(e.s * nx + e.c * ny);
    const double j2 = -nx * px * inverse_a, j3 = -ny * py * inverse_b, j4 = nx * py - ny * px;
    block->jacobian[0][i] = j0;
    block->jacobian[1][i] = j1;
    block->jacobian[2][i] = j2;
    block->jacobian[3][i] = j3;
    block->jacobian[4][i] = j4;
    block->weighted[0][i] = robust * j0;
    block->weighted[1][i] = robust * j1;
    block->weighted[2][i] = robust * j2;
    block->weighted[3][i] = robust * j3;
    block->weighted[4][i] = robust * j4;
    block->residual[i] = r;
    block->cost[i] = std::min(chi2, most);
  }
}

struct Sums {
  double h[15] = {}, g[5] = {};
  double chi2 = 0, squares = 0;
};

MONOCULAR_EYE_HAND_VECTOR_CLONES
void addUp(const FitPoints& points, const Axes& axes, double robust_scale, Sums* sums) {
  Block block;
  for (int from = 0; from < points.padded(); from += kBlock) {
    const int n = std::min(kBlock, points.padded() - from);
    fillBlock(points.x() + from, points.y() + from, points.weight() + from, points.blur2() + from, n, axes,
              robust_scale, &block);
    for (int i = std::max(0, points.count() - from); i < n; ++i) block.residual[i] = 0;  // padding
    int at = 0;
    for (int i = 0; i < 5; ++i) {
      for (int j = 0; j <= i; ++j) sums->h[at++] += dot(block.weighted[i], block.jacobian[j], n);
      sums->g[i] += dot(block.weighted[i], block.residual, n);
    }
    sums->squares += dot(block.residual, block.residual, n);
    sums->chi2 += sum(block.cost, n);
  }
}

// Sums of x^i y^j of centred and scaled coordinates, i + j = 4, 3, 2.
struct Powers {
  double xxxx = 0, xxxy = 0, xxyy = 0, xyyy = 0, yyyy = 0;
  double xxx = 0, xxy = 0, xyy = 0, yyy = 0;
  double xx = 0, xy = 0, yy = 0;
};

MONOCULAR_EYE_HAND_VECTOR_CLONES
void addUpPowers(const FitPoints& points, double u, double v, double inverse_scale, Powers* sums) {
  alignas(32) double x[kBlock], y[kBlock], xx[kBlock], xy[kBlock], yy[kBlock];
  for (int from = 0; from < points.padded(); from += kBlock) {
    const int n = std::min(kBlock, points.padded() - from), used = std::min(kBlock, points.count() - from);
    for (int i = 0; i < n; ++i) {
      x[i] = (points.x()[from + i] - u) * inverse_scale;
      y[i] = (points.y()[from + i] - v) * inverse_scale;
    }
    for (int i = std::max(0, used); i < n; ++i) x[i] = y[i] = 0;  // padding
    for (int i = 0; i < n; ++i) {
      xx[i] = x[i] * x[i];
      xy[i] = x[i] * y[i];
      yy[i] = y[i] * y[i];
    }
    sums->xxxx += dot(xx, xx, n), sums->xxxy += dot(xx, xy, n), sums->xxyy += dot(xx, yy, n);
    sums->xyyy += dot(xy, yy, n), sums->yyyy += dot(yy, yy, n);
    sums->xxx += dot(xx, x, n), sums->xxy += dot(xx, y, n), sums->xyy += dot(yy, x, n);
    sums->yyy += dot(yy, y, n);
    sums->xx += dot(x, x, n), sums->xy += dot(x, y, n), sums->yy += dot(y, y, n);
  }
}

}  // namespace

ScatterMatrices scatterMatrices(const FitPoints& points) {
  const int n = points.count();
  ScatterMatrices out;
  double u = 0, v = 0, spread = 0;
  for (int i = 0; i < n; ++i) u += points.x()[i], v += points.y()[i];
  u /= n, v /= n;
  for (int i = 0; i < n; ++i) {
    const double du = points.x()[i] - u, dv = points.y()[i] - v;
    spread += du * du + dv * dv;
  }
  out.mean = {u, v};
  out.scale = std::sqrt(spread / n);
  if (!(out.scale > 0)) return out;
  Powers p;
  addUpPowers(points, u, v, 1 / out.scale, &p);
  out.quadratic << p.xxxx, p.xxxy, p.xxyy, p.xxxy, p.xxyy, p.xyyy, p.xxyy, p.xyyy, p.yyyy;
  out.mixed << p.xxx, p.xxy, p.xx, p.xxy, p.xyy, p.xy, p.xyy, p.yyy, p.yy;
  out.linear << p.xx, p.xy, 0, p.xy, p.yy, 0, 0, 0, n;  // first moments about the mean are zero
  return out;
}

NormalEquations normalEquations(const FitPoints& points, const Ellipse& ellipse, double robust_scale) {
  const Axes axes{ellipse.centre.x(),      ellipse.centre.y(), std::cos(ellipse.angle),
                  std::sin(ellipse.angle), ellipse.a,          ellipse.b};
  Sums sums;
  addUp(points, axes, robust_scale, &sums);
  NormalEquations out;
  int at = 0;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j <= i; ++j) out.h(i, j) = out.h(j, i) = sums.h[at++];
    out.g[i] = sums.g[i];
  }
  out.chi2 = sums.chi2;
  out.squares = sums.squares;
  return out;
}

}  // namespace monocular_eye_hand
