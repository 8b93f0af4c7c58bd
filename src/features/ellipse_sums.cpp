#include "features/ellipse_sums.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/vector_clones.h"

namespace monocular_eye_hand {
namespace {

constexpr int kLanes = FitPoints::kLanes;
constexpr int kBlock = 64;      // points whose columns stay in the cache together
constexpr double kTukey = 4.0;  // standard deviations

// Sums run in kLanes interleaved parts: the order of the additions does not depend on the vector width.
typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double)), may_alias));

// Adds to each of `sums` the sum of products of `a` with one of the columns, all in one pass.
template <int kCount>
MONOCULAR_EYE_HAND_INLINE void addDots(const double* a, const double* const (&columns)[kCount], int n,
                                       double* const (&sums)[kCount]) {
  Lanes part[kCount] = {};
  for (int i = 0; i < n; i += kLanes)
    for (int c = 0; c < kCount; ++c)
      part[c] += *reinterpret_cast<const Lanes*>(a + i) * *reinterpret_cast<const Lanes*>(columns[c] + i);
  for (int c = 0; c < kCount; ++c) *sums[c] += (part[c][0] + part[c][1]) + (part[c][2] + part[c][3]);
}
MONOCULAR_EYE_HAND_INLINE double sum(const double* a, int n) {
  Lanes part = {};
  for (int i = 0; i < n; i += kLanes) part += *reinterpret_cast<const Lanes*>(a + i);
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
  const double max_chi2 = 9 * robust_scale * robust_scale;

  for (int i = 0; i < n; ++i) {
    const double du = x[i] - e.u, dv = y[i] - e.v;
    const double px = e.c * du + e.s * dv, py = e.c * dv - e.s * du;  // in the ellipse's own axes
    const double xx = px * px * ia, yy = py * py * ib;
    // F = x^2 / a^2 + y^2 / b^2 - 1 and its gradient.
    const double f = xx + yy - 1, gx = 2 * px * ia, gy = 2 * py * ib;
    const double inverse_g = 1 / std::max(1e-9, std::sqrt(gx * gx + gy * gy));
    const double nx = gx * inverse_g, ny = gy * inverse_g;

    // Curvature where the ray from the centre through the point meets the ellipse: a b / q^(3/2).
    const double d = std::max(1e-18, xx + yy), inverse_d = 1 / d, q = (a2 * yy + b2 * xx) * inverse_d;
    const double inward = std::min(0.5, 0.5 * blur2[i] * ab / (q * std::sqrt(q)));
    const double sampson = f * inverse_g;
    const double r = sampson + inward, chi2 = r * r * weight[i];
    const double inside = std::max(0.0, 1 - chi2 * tukey), robust = weight[i] * inside * inside;

    // Derivatives of both parts by the point in the ellipse's axes and by a and b.
    const double sg = 2 * sampson * inverse_g, iq = 3 * inward * inverse_d / q;
    const double rx = nx * (1 - sg * ia) - iq * px * ia * (b2 - q);
    const double ry = ny * (1 - sg * ib) - iq * py * ib * (a2 - q);
    const double ra =
        (2 * sampson * nx * nx - nx * px + inward - iq * (a2 * yy - b2 * xx + q * xx)) * inverse_a;
    const double rb =
        (2 * sampson * ny * ny - ny * py + inward - iq * (b2 * xx - a2 * yy + q * yy)) * inverse_b;
    const double j0 = e.s * ry - e.c * rx, j1 = -(e.s * rx + e.c * ry);
    const double j2 = ra, j3 = rb, j4 = rx * py - ry * px;

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
    block->cost[i] = std::min(chi2, max_chi2);
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

    const auto& j = block.jacobian;
    const auto& w = block.weighted;
    double *h = sums->h, *g = sums->g;
    const double* r = block.residual;
    addDots<2>(w[0], {j[0], r}, n, {h, g});
    addDots<3>(w[1], {j[0], j[1], r}, n, {h + 1, h + 2, g + 1});
    addDots<4>(w[2], {j[0], j[1], j[2], r}, n, {h + 3, h + 4, h + 5, g + 2});
    addDots<5>(w[3], {j[0], j[1], j[2], j[3], r}, n, {h + 6, h + 7, h + 8, h + 9, g + 3});
    addDots<6>(w[4], {j[0], j[1], j[2], j[3], j[4], r}, n, {h + 10, h + 11, h + 12, h + 13, h + 14, g + 4});
    addDots<1>(r, {r}, n, {&sums->squares});
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

    addDots<5>(xx, {xx, xy, yy, x, y}, n, {&sums->xxxx, &sums->xxxy, &sums->xxyy, &sums->xxx, &sums->xxy});
    addDots<4>(yy, {xy, yy, x, y}, n, {&sums->xyyy, &sums->yyyy, &sums->xyy, &sums->yyy});
    addDots<2>(x, {x, y}, n, {&sums->xx, &sums->xy});
    addDots<1>(y, {y}, n, {&sums->yy});
  }
}

}  // namespace

ScatterMatrices scatterMatrices(const FitPoints& points) {
  const int n = points.count();
  ScatterMatrices out;
  double u = 0, v = 0, spread = 0;
  for (int i = 0; i < n; ++i) {
    u += points.x()[i];
    v += points.y()[i];
  }
  u /= n;
  v /= n;
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

EllipseNormalEquations normalEquations(const FitPoints& points, const Ellipse& ellipse, double robust_scale) {
  const Axes axes{ellipse.centre.x(),      ellipse.centre.y(), std::cos(ellipse.angle),
                  std::sin(ellipse.angle), ellipse.a,          ellipse.b};
  Sums sums;
  addUp(points, axes, robust_scale, &sums);
  EllipseNormalEquations out;
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
