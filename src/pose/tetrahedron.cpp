#include "pose/tetrahedron.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

// The ratios of the legs are the common points of two conics, the differences of the cosine laws (seed, eqs.
// 3-5) with the scale eliminated. A degenerate member of their pencil, one root of a cubic, is a pair of
// lines, and each line meets the conics in two of the four solutions (Finsterwalder's method in the
// projective plane, see Haralick et al., IJCV 13, 1994). Three choices make it sharp:
//  - coordinates (x, y, w) with legs (w + e x, w + e y, w), e = the angular size of the triangle, and 1 - cos
//  taken
//    from |j_i - j_k|^2: the four roots stay apart when the object is far, where the usual quartic is (x -
//    1)^4;
//  - everything homogeneous, no direction singled out, and the pencil turned away from the members that
//  degenerate
//    in symmetric views;
//  - of three real cubic roots the one that lies apart, so that a double solution costs no digits elsewhere.
// Newton's method on the cosine laws then takes each root to rounding.
namespace monocular_eye_hand {
namespace {

/// xx x^2 + yy y^2 + ww w^2 + 2 (xy x y + xw x w + yw y w).
struct Form {
  double xx, yy, ww, xy, xw, yw;
};

Form combine(double s, const Form& a, double t, const Form& b) {
  return {s * a.xx + t * b.xx, s * a.yy + t * b.yy, s * a.ww + t * b.ww,
          s * a.xy + t * b.xy, s * a.xw + t * b.xw, s * a.yw + t * b.yw};
}

Form adjugate(const Form& f) {
  return {f.yy * f.ww - f.yw * f.yw, f.xx * f.ww - f.xw * f.xw, f.xx * f.yy - f.xy * f.xy,
          f.xw * f.yw - f.xy * f.ww, f.xy * f.yw - f.xw * f.yy, f.xy * f.xw - f.xx * f.yw};
}

double product(const Form& a, const Form& b) {  // trace of the matrices' product
  return a.xx * b.xx + a.yy * b.yy + a.ww * b.ww + 2 * (a.xy * b.xy + a.xw * b.xw + a.yw * b.yw);
}

/// The real root of x^3 + b x^2 + c x + d that lies farthest from the inflection point: simple unless all
/// three coincide.
double isolatedRoot(double b, double c, double d) {
  const double x0 = -b / 3;
  const double p = c + b * x0 * 2 + 3 * x0 * x0, q = ((x0 + b) * x0 + c) * x0 + d;
  const double w = std::abs(q);  // x = x0 - sign(q) y with y^3 + p y = w, y >= 0; start above the root
  double y;
  if (p < 0) {
    const double s = std::sqrt(-p), k = w / (s * s * s);
    y = s * (k < 2 ? 1 + k / (2 + 0.6 * k) : 1 + std::cbrt(k));
  } else {
    y = w < p * std::sqrt(p) ? w / p : std::cbrt(w);
  }
  for (int i = 0; i < 12; ++i) {
    const double slope = 3 * y * y + p;
    if (!(slope > 0)) break;
    const double step = ((y * y + p) * y - w) / slope;
    y -= step;
    if (std::abs(step) < 1e-6 * y) break;
  }
  double x = q > 0 ? x0 - y : x0 + y;
  const double slope =
      (3 * x + 2 * b) * x + c;  // once more in the polynomial as given: the shift has rounded
  if (slope != 0) x -= (((x + b) * x + c) * x + d) / slope;
  return x;
}

/// Splits a degenerate form into two lines (rows). False when they are not real.
bool splitLines(const Form& f, Eigen::Vector3d* lines) {
  const Form adj = adjugate(f);
  const double size = product(f, f);
  const double ax = std::abs(adj.xx), ay = std::abs(adj.yy), aw = std::abs(adj.ww);
  double diagonal;
  Eigen::Vector3d p;  // where the lines meet
  if (ax >= ay && ax >= aw)
    diagonal = adj.xx, p = {adj.xx, adj.xy, adj.xw};
  else if (ay >= aw)
    diagonal = adj.yy, p = {adj.xy, adj.yy, adj.yw};
  else
    diagonal = adj.ww, p = {adj.xw, adj.yw, adj.ww};
  if (diagonal < 0)
    p *= 1 / std::sqrt(-diagonal);
  else if (diagonal > 1e-9 * size)
    return false;
  else
    p.setZero();  // a double line up to rounding
  // form + skew(p) = (line 1) (line 2)^T
  const Eigen::Vector3d rows[3] = {{f.xx, f.xy - p.z(), f.xw + p.y()},
                                   {f.xy + p.z(), f.yy, f.yw - p.x()},
                                   {f.xw - p.y(), f.yw + p.x(), f.ww}};
  int i = 0, k = 0;
  double largest = -1;
  for (int r = 0; r < 3; ++r) {
    const double n = rows[r].squaredNorm();
    if (n > largest) largest = n, i = r;
  }
  lines[0] = rows[i];
  lines[0].cwiseAbs().maxCoeff(&k);
  lines[1] = {rows[0][k], rows[1][k], rows[2][k]};
  return largest > 0;
}

/// The points of the conic `f` on a line: none, one (tangent up to rounding) or two.
int meet(const Form& f, const Eigen::Vector3d& line, Eigen::Vector3d* points) {
  const double m[3][3] = {{f.xx, f.xy, f.xw}, {f.xy, f.yy, f.yw}, {f.xw, f.yw, f.ww}};
  const double l[3] = {std::abs(line[0]), std::abs(line[1]), std::abs(line[2])};
  const int k = l[0] >= l[1] ? (l[0] >= l[2] ? 0 : 2) : (l[1] >= l[2] ? 1 : 2);
  const int i = k == 2 ? 0 : k + 1, n = k == 0 ? 2 : k - 1;
  if (!(l[k] > 0)) return 0;
  const double scale = 1 / line[k], ri = -line[i] * scale, rn = -line[n] * scale;
  const double a = m[i][i] + ri * (2 * m[i][k] + ri * m[k][k]);
  const double b = m[i][n] + rn * m[i][k] + ri * (m[n][k] + rn * m[k][k]);
  const double c = m[n][n] + rn * (2 * m[n][k] + rn * m[k][k]);
  double discriminant = b * b - a * c;
  int count = 2;
  if (discriminant <= 0) {
    if (!(discriminant > -1e-9 * (b * b + a * a + c * c))) return 0;
    discriminant = 0;
    count = 1;
  }
  const double z = -(b + std::copysign(std::sqrt(discriminant), b));  // a s^2 + 2 b s t + c t^2 = 0
  const double st[2][2] = {{z, a}, {c, z}};
  if (count == 1 && std::abs(c) > std::abs(a)) {
    points[0][i] = c, points[0][n] = z;
    points[0][k] = ri * c + rn * z;
    return 1;
  }
  for (int s = 0; s < count; ++s) {
    points[s][i] = st[s][0];
    points[s][n] = st[s][1];
    points[s][k] = ri * st[s][0] + rn * st[s][1];
  }
  return count;
}

/// Newton on the three cosine laws, written for side 12, the right angle at the foot, and the altitude.
bool polish(const Eigen::Vector3d* j, const BaseTriangle& t, TetrahedronRoot* root) {
  Eigen::Vector3d& legs = root->legs;
  const double altitude2 = t.altitude * t.altitude, inverse_altitude = 1 / t.altitude, f = t.foot,
               g = 1 - t.foot;
  double step = 1;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d p1 = legs[0] * j[0], p2 = legs[1] * j[1], p3 = legs[2] * j[2];
    const Eigen::Vector3d q = p2 - p1, h = p3 - (g * p1 + f * p2);
    root->base = q;
    root->height = h;
    const double q1 = q.dot(j[0]), q2 = q.dot(j[1]), q3 = q.dot(j[2]);
    const double h1 = h.dot(j[0]), h2 = h.dot(j[1]), h3 = h.dot(j[2]);
    const double r1 = 0.5 * (q.squaredNorm() - 1), r2 = q.dot(h), r3 = 0.5 * (h.squaredNorm() - altitude2);
    const double sum = legs[0] + legs[1] + legs[2];
    const double residual = std::max({std::abs(r1), std::abs(r2), std::abs(r3) * inverse_altitude});
    if (residual < 4e-16 * sum) {  // a step would be made of rounding
      step = 0;
      break;
    }
    // rows: (-q1, q2, 0), (-h1 - g q1, h2 - f q2, q3), (-g h1, -f h2, h3)
    const double b1 = -h1 - g * q1, b2 = h2 - f * q2, c1 = -g * h1, c2 = -f * h2;
    const double m1 = b2 * h3 - q3 * c2, m2 = b1 * h3 - q3 * c1;
    const double det = -q1 * m1 - q2 * m2;
    const double inverse = 1 / det;
    const double n = r2 * h3 - q3 * r3;
    const double d1 = (r1 * m1 - q2 * n) * inverse;
    const double d2 = (-q1 * n - r1 * m2) * inverse;
    const double d3 =
        std::abs(h3) > std::abs(q3) ? (r3 - c1 * d1 - c2 * d2) / h3 : (r2 - b1 * d1 - b2 * d2) / q3;
    const double size = std::max({std::abs(d1), std::abs(d2), std::abs(d3)});
    if (!(size < 1e8 * residual)) {  // singular: a double root is as good as it can be found
      if (residual < 1e-12 * sum) step = 0;
      break;
    }
    if (step < 1e-7 && size >= step) break;  // rounding
    step = size;
    legs[0] -= d1;
    legs[1] -= d2;
    legs[2] -= d3;
    if (size < 1e-10) {
      const Eigen::Vector3d s1 = d1 * j[0], s2 = d2 * j[1];
      root->base += s1 - s2;
      root->height += g * s1 + f * s2 - d3 * j[2];
      break;
    }
  }
  return step < 1e-6 && legs.minCoeff() > 0;
}

}  // namespace

int solveBaseTriangle(const Eigen::Vector3d* j, const BaseTriangle& t, TetrahedronRoot* roots) {
  const double e12 = (j[0] - j[1]).squaredNorm(), e13 = (j[0] - j[2]).squaredNorm(),
               e23 = (j[1] - j[2]).squaredNorm();
  const double e2 = std::max({e12, e13, e23});
  if (!(e2 > 0) || !std::isfinite(e2) || !(t.altitude > 0)) return 0;
  const double e = std::sqrt(e2), scale = 1 / e2;
  const double E12 = e12 * scale, E13 = e13 * scale, E23 = e23 * scale, a13 = t.a13, a23 = t.a23;
  // (d_i - d_k)^2 + e_ik d_i d_k = a_ik, pairwise without the scale
  const double w12 = a23 * E12 - E23;
  const Form d1 = {a23, a23 - 1, w12, a23 * (0.5 * e12 - 1), 0.5 * e * a23 * E12, 0.5 * e * w12};
  const Form d2 = {a23, -a13, a23 * E13 - a13 * E23, 0, 0.5 * e * a23 * E13, -0.5 * e * a13 * E23};
  const double turn = 0.4;
  Form a = combine(1, d1, turn, d2), b = combine(-turn, d1, 1, d2);
  Form adj_a = adjugate(a), adj_b = adjugate(b);
  double det_a = a.xx * adj_a.xx + a.xy * adj_a.xy + a.xw * adj_a.xw;
  double det_b = b.xx * adj_b.xx + b.xy * adj_b.xy + b.xw * adj_b.xw;
  if (std::abs(det_b) < std::abs(det_a)) std::swap(a, b), std::swap(adj_a, adj_b), std::swap(det_a, det_b);
  const double c1 = product(adj_a, b), c2 = product(adj_b, a);
  const double smallest = 1e-18 * (std::abs(c1) + std::abs(c2));
  if (std::abs(det_b) < smallest) det_b = smallest;
  if (!(std::abs(det_b) > 0)) return 0;
  const double monic = 1 / det_b;
  const double g = isolatedRoot(c2 * monic, c1 * monic, det_a * monic);
  const double n = 1 / std::sqrt(1 + g * g);
  if (!(n > 0)) return 0;
  Eigen::Vector3d lines[2];
  if (!splitLines(combine(n, a, n * g, b), lines)) return 0;
  const Form other = combine(n * g, a, -n, b);
  int count = 0;
  for (const Eigen::Vector3d& line : lines) {
    Eigen::Vector3d at[2];
    const int met = meet(other, line, at);
    for (int s = 0; s < met && count < 4; ++s) {
      Eigen::Vector3d d(at[s][2] + e * at[s][0], at[s][2] + e * at[s][1], at[s][2]);
      if (d[2] < 0) d = -d;
      if (!(d[0] > 0 && d[1] > 0 && d[2] > 0)) continue;
      const double x = d[0] - d[1], y = d[0] - d[2], z = d[1] - d[2];
      const double sum = x * x + y * y + z * z + e12 * d[0] * d[1] + e13 * d[0] * d[2] + e23 * d[1] * d[2];
      TetrahedronRoot& root = roots[count];
      root.legs = d * std::sqrt((1 + a13 + a23) / sum);
      if (!polish(j, t, &root)) continue;
      bool known = false;
      for (int m = 0; m < count; ++m)
        known |= (roots[m].legs - root.legs).cwiseAbs().maxCoeff() < 1e-7 * t.altitude;
      if (!known) ++count;
    }
  }
  return count;
}

TriangleOrder longestSideFirst(double a12, double a13, double a23) {
  if (a12 >= a13 && a12 >= a23) return {0, 1, 2};
  if (a13 >= a23) return {0, 2, 1};
  return {1, 2, 0};
}

}  // namespace monocular_eye_hand
