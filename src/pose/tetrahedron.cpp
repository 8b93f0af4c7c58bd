#include "pose/tetrahedron.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

// The ratios of the legs are the common points of two conics, the differences of the cosine laws (Wong et
// al., eqs. 3-5) with the scale eliminated. A degenerate member of their pencil, one root of a cubic, is a
// pair of lines, and each line meets the conics in two of the four solutions (Finsterwalder's method in the
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

/// Residual of a double root, over the sum of the legs, below which rounding may have made it a complex pair.
constexpr double kRounding = 2e-14;

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

/// Cube root to a few per cent: a third of the binary exponent.
double roughCubeRoot(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits = bits / 3 + 0x2A9F7893782DA1CE;
  std::memcpy(&x, &bits, sizeof bits);
  return x;
}

/// The root y >= 0 of y^3 + p y = w, w >= 0, to a few per cent at least.
double roughRoot(double p, double w) {
  const double s2 = -p;
  if (p < 0 && w * w < 0.15 * s2 * s2 * s2) {  // three real roots, to 1e-3
    const double s = std::sqrt(s2);
    return s + s * w / (2 * s2 * s + 1.27 * w);
  }
  const double c = roughCubeRoot(w), c2 = c * c;
  if (p < 0) return (3 * c2 + s2) / (3 * c);
  return w * (c2 + p) / (p * (c2 + p) + c2 * c2);
}

/// The real root of x^3 + b x^2 + c x + d that lies farthest from the inflection point: simple unless all
/// three coincide.
double isolatedRoot(double b, double c, double d) {
  const double x0 = b * (-1.0 / 3);
  const double p = c + b * x0 * 2 + 3 * x0 * x0, q = ((x0 + b) * x0 + c) * x0 + d;
  const double w = std::abs(q);  // x = x0 - sign(q) y with y^3 + p y = w
  if (!(w > 1e-290)) return p < 0 ? x0 - std::copysign(std::sqrt(-p), q) : x0;
  double y = roughRoot(p, w);
  const double f = (y * y + p) * y - w, slope = 3 * y * y + p;
  y -= f * slope / (slope * slope - 3 * y * f);  // Halley
  double x = x0 - std::copysign(y, q);
  for (int i = 0; i < 8; ++i) {  // Newton in the polynomial as given: the shift has rounded
    const double slope_x = (3 * x + 2 * b) * x + c;
    if (slope_x == 0) break;
    const double step = (((x + b) * x + c) * x + d) / slope_x;
    x -= step;
    if (!(std::abs(step) > 1e-7 * y)) break;
  }
  return x;
}

/// Index of the largest of three numbers, without a branch: it is as good as random here.
int largest(double x, double y, double z) { return y > x ? (z > y ? 2 : 1) : (z > x ? 2 : 0); }

/// Splits a degenerate form into two lines. False when they are not real.
bool splitLines(const Form& f, double (*lines)[3]) {
  const Form adj = adjugate(f);
  const double columns[3][3] = {{adj.xx, adj.xy, adj.xw}, {adj.xy, adj.yy, adj.yw}, {adj.xw, adj.yw, adj.ww}};
  const int c = largest(std::abs(adj.xx), std::abs(adj.yy), std::abs(adj.ww));
  const double diagonal = columns[c][c];

  double scale = 0;  // a double line up to rounding
  if (diagonal < 0)
    scale = 1 / std::sqrt(-diagonal);
  else if (diagonal > 1e-9 * product(f, f))
    return false;
  const double x = scale * columns[c][0], y = scale * columns[c][1],
               w = scale * columns[c][2];  // where the lines meet

  // form + skew(x, y, w) = (line 1) (line 2)^T
  const double rows[3][3] = {
      {f.xx, f.xy - w, f.xw + y}, {f.xy + w, f.yy, f.yw - x}, {f.xw - y, f.yw + x, f.ww}};
  double size[3];
  for (int r = 0; r < 3; ++r)
    size[r] = rows[r][0] * rows[r][0] + rows[r][1] * rows[r][1] + rows[r][2] * rows[r][2];
  const int r = largest(size[0], size[1], size[2]);
  const int k = largest(std::abs(rows[r][0]), std::abs(rows[r][1]), std::abs(rows[r][2]));
  for (int i = 0; i < 3; ++i) {
    lines[0][i] = rows[r][i];
    lines[1][i] = rows[i][k];
  }
  return size[r] > 0;
}

/// The points of the conic `f` on a line, homogeneous: as many as are real, one where they touch up to
/// rounding.
struct Meeting {
  double points[2][3];
  bool valid[2];
};

Meeting meet(const Form& f, const double* line) {
  static constexpr int kNext[3][2] = {{1, 2}, {2, 0}, {0, 1}};
  const double m[3][3] = {{f.xx, f.xy, f.xw}, {f.xy, f.yy, f.yw}, {f.xw, f.yw, f.ww}};
  const int k = largest(std::abs(line[0]), std::abs(line[1]), std::abs(line[2]));
  const int i = kNext[k][0], n = kNext[k][1];

  // point = s (l_k e_i - l_i e_k) + t (l_k e_n - l_n e_k)
  const double lk = line[k], li = line[i], ln = line[n];
  const double iik = lk * m[i][i] - li * m[i][k], ikk = lk * m[i][k] - li * m[k][k];
  const double a = lk * iik - li * ikk;
  const double b = lk * (lk * m[i][n] - li * m[n][k]) - ln * ikk;
  const double c = lk * (lk * m[n][n] - 2 * ln * m[n][k]) + ln * ln * m[k][k];
  const double discriminant = b * b - a * c;
  const double z = -(b + std::copysign(std::sqrt(std::max(0.0, discriminant)), b));
  const double s[2] = {z, c}, t[2] = {a, z};  // a s^2 + 2 b s t + c t^2 = 0

  Meeting result;
  for (int p = 0; p < 2; ++p) {
    result.points[p][i] = lk * s[p];
    result.points[p][n] = lk * t[p];
    result.points[p][k] = -(li * s[p] + ln * t[p]);
  }
  result.valid[0] = result.valid[1] = discriminant > 0;
  if (discriminant <= 0 && discriminant > -1e-9 * (b * b + a * a + c * c))
    result.valid[std::abs(c) > std::abs(a)] = true;
  return result;
}

/// Newton on the three cosine laws, written for side 12, the right angle at the foot, and the altitude.
bool polish(const Eigen::Vector3d* j, const BaseTriangle& t, TetrahedronRoot* root) {
  Eigen::Vector3d& legs = root->legs;
  const double altitude2 = t.altitude * t.altitude, inverse_altitude = 1 / t.altitude, f = t.foot,
               g = 1 - t.foot;
  double step = 1;
  bool rounding = false;  // the residual is made of it
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
    if (residual < 4e-16 * sum) return legs.minCoeff() > 0;  // a step would be made of rounding
    rounding = residual < kRounding * sum;

    // rows: (-q1, q2, 0), (-h1 - g q1, h2 - f q2, q3), (-g h1, -f h2, h3)
    const double b1 = -h1 - g * q1, b2 = h2 - f * q2, c1 = -g * h1, c2 = -f * h2;
    const double m1 = b2 * h3 - q3 * c2, m2 = b1 * h3 - q3 * c1;
    const double det = -q1 * m1 - q2 * m2;
    const double inverse = 1 / det;
    const double n = r2 * h3 - q3 * r3;
    const double d1 = (r1 * m1 - q2 * n) * inverse;
    const double d2 = (-q1 * n - r1 * m2) * inverse;
    const double d3 =
        (r1 * (b1 * c2 - b2 * c1) + r2 * (q1 * c2 + q2 * c1) - r3 * (q1 * b2 + q2 * b1)) * inverse;

    const double size = std::max({std::abs(d1), std::abs(d2), std::abs(d3)});
    if (!(size < 1e8 * residual)) break;     // singular: a double root is as good as it can be found
    if (step < 1e-7 && size >= step) break;  // rounding
    step = size;
    legs[0] -= d1;
    legs[1] -= d2;
    legs[2] -= d3;
    if (size < 1e-10) {
      const Eigen::Vector3d s1 = d1 * j[0], s2 = d2 * j[1];
      root->base += s1 - s2;
      root->height += g * s1 + f * s2 - d3 * j[2];
      return legs.minCoeff() > 0;
    }
  }
  return rounding && legs.minCoeff() > 0;
}

}  // namespace

int solveBaseTriangle(const Eigen::Vector3d* j, const BaseTriangle& triangle, TetrahedronRoot* roots) {
  const double e12 = (j[0] - j[1]).squaredNorm(), e13 = (j[0] - j[2]).squaredNorm(),
               e23 = (j[1] - j[2]).squaredNorm();
  const double e2 = std::max({e12, e13, e23});
  if (!(e2 > 0) || !std::isfinite(e2) || !(triangle.altitude > 0)) return 0;
  const double e = std::sqrt(e2), scale = 1 / e2;
  const double E12 = e12 * scale, E13 = e13 * scale, E23 = e23 * scale, a13 = triangle.a13,
               a23 = triangle.a23;

  // (d_i - d_k)^2 + e_ik d_i d_k = a_ik, pairwise without the scale
  const double w12 = a23 * E12 - E23;
  const Form d1 = {a23, a23 - 1, w12, a23 * (0.5 * e12 - 1), 0.5 * e * a23 * E12, 0.5 * e * w12};
  const Form d2 = {a23, -a13, a23 * E13 - a13 * E23, 0, 0.5 * e * a23 * E13, -0.5 * e * a13 * E23};
  const double turn = 0.4;
  const Form a = combine(1, d1, turn, d2), b = combine(-turn, d1, 1, d2);
  const Form adj_a = adjugate(a), adj_b = adjugate(b);

  // det(s a + t b) as a cubic in the ratio of that weight to the other whose own determinant is the larger
  const double det_a = a.xx * adj_a.xx + a.xy * adj_a.xy + a.xw * adj_a.xw;
  const double det_b = b.xx * adj_b.xx + b.xy * adj_b.xy + b.xw * adj_b.xw;
  const double mixed_a = product(adj_a, b), mixed_b = product(adj_b, a);
  const bool by_b = !(std::abs(det_b) < std::abs(det_a));
  const double c0 = by_b ? det_a : det_b, c1 = by_b ? mixed_a : mixed_b, c2 = by_b ? mixed_b : mixed_a;
  const double smallest = 1e-18 * (std::abs(c1) + std::abs(c2));
  double c3 = by_b ? det_b : det_a;
  if (std::abs(c3) < smallest) c3 = smallest;
  if (!(std::abs(c3) > 0)) return 0;
  const double monic = 1 / c3;
  const double g = isolatedRoot(c2 * monic, c1 * monic, c0 * monic);
  const double s = by_b ? 1 : g, t = by_b ? g : 1;

  double lines[2][3];
  if (!splitLines(combine(s, a, t, b), lines)) return 0;
  const Form other = combine(t, a, -s, b);
  Eigen::Vector3d candidates[5];
  int tried = 0;
  const Meeting meetings[2] = {meet(other, lines[0]), meet(other, lines[1])};
  for (const Meeting& meeting : meetings) {
    for (int p = 0; p < 2; ++p) {
      const double* at = meeting.points[p];
      const double w = at[2], x = w + e * at[0], y = w + e * at[1];
      const double side1 = x - y, side2 = x - w, side3 = y - w;
      const double sum =
          side1 * side1 + side2 * side2 + side3 * side3 + e12 * x * y + e13 * x * w + e23 * y * w;
      const double scale = std::copysign(std::sqrt((1 + a13 + a23) / sum), w);
      candidates[tried] << scale * x, scale * y, scale * w;
      tried += int(meeting.valid[p]) & int(x * w > 0) & int(y * w > 0);
    }
  }

  int count = 0;
  for (int c = 0; c < tried; ++c) {
    TetrahedronRoot& root = roots[count];
    root.legs = candidates[c];
    if (!polish(j, triangle, &root)) continue;
    bool known = false;
    for (int m = 0; m < count; ++m)
      known |= (roots[m].legs - root.legs).cwiseAbs().maxCoeff() < 1e-7 * triangle.altitude;
    if (!known) ++count;
  }
  return count;
}

}  // namespace monocular_eye_hand
