#pragma once
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand::shapes {

// Meshes as CAD exporters write them: every triangle with its own three vertices. Millimetre-sized parts in
// metres.

constexpr double kPi = 3.14159265358979323846;
using Point = Eigen::Vector3d;

inline void triangle(Mesh* m, const Point& a, const Point& b, const Point& c) {
  const int i = int(m->vertices.size());
  m->vertices.insert(m->vertices.end(), {a, b, c});
  m->triangles.push_back({i, i + 1, i + 2});
}
inline void quad(Mesh* m, const Point& a, const Point& b, const Point& c, const Point& d) {
  triangle(m, a, b, c);
  triangle(m, a, c, d);
}
inline void append(Mesh* m, const Mesh& other) {
  for (const auto& t : other.triangles)
    triangle(m, other.vertices[t[0]], other.vertices[t[1]], other.vertices[t[2]]);
}
inline Mesh moved(const Mesh& m, const Rigid3& motion) {
  Mesh out = m;
  for (Point& p : out.vertices) p = motion * p;
  return out;
}
inline Mesh rounded(const Mesh& m) {  // through single precision, as STL files do
  Mesh out = m;
  for (Point& p : out.vertices) p = p.cast<float>().cast<double>();
  return out;
}
inline Mesh reversed(const Mesh& m) {
  Mesh out = m;
  for (auto& t : out.triangles) std::swap(t[1], t[2]);
  return out;
}
inline Rigid3 somewhere(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> g;
  const Eigen::Quaterniond q(g(random), g(random), g(random), g(random));
  return {q.normalized().toRotationMatrix(), Point(0.02 * g(random), 0.02 * g(random), 0.02 * g(random))};
}

inline Mesh box(double x, double y, double z) {
  const auto p = [&](int i) {
    return Point(i & 1 ? x / 2 : -x / 2, i & 2 ? y / 2 : -y / 2, i & 4 ? z / 2 : -z / 2);
  };
  Mesh m;
  quad(&m, p(0), p(2), p(3), p(1));
  quad(&m, p(4), p(5), p(7), p(6));
  quad(&m, p(0), p(1), p(5), p(4));
  quad(&m, p(3), p(2), p(6), p(7));
  quad(&m, p(1), p(3), p(7), p(5));
  quad(&m, p(2), p(0), p(4), p(6));
  return m;
}

using Outline = std::vector<Eigen::Vector2d>;
inline Outline polygon(int n, double radius, double turn = 0) {
  Outline out;
  for (int k = 0; k < n; ++k) {
    const double a = turn + 2 * kPi * k / n;
    out.emplace_back(radius * std::cos(a), radius * std::sin(a));
  }
  return out;
}
inline Point at(const Eigen::Vector2d& p, double z) { return {p.x(), p.y(), z}; }

/// Wall of a counter-clockwise outline, facing out; `rows` facets high.
inline void wall(Mesh* m, const Outline& o, double low, double high, int rows = 1, bool outward = true) {
  for (int r = 0; r < rows; ++r) {
    const double z0 = low + (high - low) * r / rows, z1 = low + (high - low) * (r + 1) / rows;
    for (size_t k = 0; k < o.size(); ++k) {
      const auto &a = o[k], &b = o[(k + 1) % o.size()];
      if (outward) quad(m, at(a, z0), at(b, z0), at(b, z1), at(a, z1));
      if (!outward) quad(m, at(b, z0), at(a, z0), at(a, z1), at(b, z1));
    }
  }
}
/// Flat ring between two outlines of equally many points, facing up or down.
inline void ring(Mesh* m, const Outline& outer, const Outline& inner, double z, bool up) {
  for (size_t k = 0; k < outer.size(); ++k) {
    const size_t n = (k + 1) % outer.size();
    if (up) quad(m, at(outer[k], z), at(outer[n], z), at(inner[n], z), at(inner[k], z));
    if (!up) quad(m, at(outer[n], z), at(outer[k], z), at(inner[k], z), at(inner[n], z));
  }
}
inline void cap(Mesh* m, const Outline& o, double z, bool up) {  // convex outlines
  for (size_t k = 2; k < o.size(); ++k) {
    if (up) triangle(m, at(o[0], z), at(o[k - 1], z), at(o[k], z));
    if (!up) triangle(m, at(o[0], z), at(o[k], z), at(o[k - 1], z));
  }
}
inline Mesh prism(const Outline& o, double height, int rows = 1) {
  Mesh m;
  wall(&m, o, 0, height, rows);
  cap(&m, o, 0, false);
  cap(&m, o, height, true);
  return m;
}
inline Mesh cylinder(int n, double radius, double height, int rows = 1) {
  return prism(polygon(n, radius), height, rows);
}
inline Mesh tube(int n, double outer, double inner, double height) {
  Mesh m;
  wall(&m, polygon(n, outer), 0, height);
  wall(&m, polygon(n, inner), 0, height, 1, false);
  ring(&m, polygon(n, outer), polygon(n, inner), height, true);
  ring(&m, polygon(n, outer), polygon(n, inner), 0, false);
  return m;
}
/// Square plate of side 2 `half` with a round hole of n segments (n divisible by 4).
inline Mesh plateWithHole(int n, double half, double radius, double height) {
  Outline outer = polygon(n, 1.0, kPi / 4);
  for (auto& p : outer) p *= half / p.cwiseAbs().maxCoeff();
  Mesh m;
  wall(&m, outer, 0, height);
  wall(&m, polygon(n, radius, kPi / 4), 0, height, 1, false);
  ring(&m, outer, polygon(n, radius, kPi / 4), height, true);
  ring(&m, outer, polygon(n, radius, kPi / 4), 0, false);
  return m;
}
/// Outline of a slot: two half circles of n segments joined by straight sides.
inline Outline slot(int n, double radius, double half_length) {
  Outline o;
  for (int k = 0; k <= n; ++k)
    o.emplace_back(half_length + radius * std::cos(kPi * k / n - kPi / 2),
                   radius * std::sin(kPi * k / n - kPi / 2));
  for (int k = 0; k <= n; ++k)
    o.emplace_back(-half_length + radius * std::cos(kPi * k / n + kPi / 2),
                   radius * std::sin(kPi * k / n + kPi / 2));
  return o;
}
/// Rectangle with rounded corners, n segments per corner.
inline Outline roundedRectangle(int n, double x, double y, double radius) {
  Outline o;
  for (int c = 0; c < 4; ++c) {
    const double a0 = c * kPi / 2;
    const Eigen::Vector2d centre((c == 0 || c == 3 ? 1 : -1) * (x / 2 - radius),
                                 (c < 2 ? 1 : -1) * (y / 2 - radius));
    for (int k = 0; k <= n; ++k) {
      const double a = a0 + kPi / 2 * k / n;
      o.push_back(centre + radius * Eigen::Vector2d(std::cos(a), std::sin(a)));
    }
  }
  return o;
}
/// Surface of revolution of a profile (radius, z) that starts and ends on the axis.
inline Mesh revolved(const Outline& profile, int n) {
  Mesh m;
  const auto p = [&](size_t i, int k) {
    const double a = 2 * kPi * (k % n) / n;
    return Point(profile[i].x() * std::cos(a), profile[i].x() * std::sin(a), profile[i].y());
  };
  for (size_t i = 0; i + 1 < profile.size(); ++i) {
    for (int k = 0; k < n; ++k) {
      if (profile[i].x() > 0) triangle(&m, p(i, k), p(i, k + 1), p(i + 1, k + 1));
      if (profile[i + 1].x() > 0) triangle(&m, p(i, k), p(i + 1, k + 1), p(i + 1, k));
    }
  }
  return m;
}
inline Mesh sphere(int n, double radius) {
  Outline profile{{0, -radius}};
  for (int k = 1; k < n / 2; ++k) {
    const double a = 2 * kPi * k / n - kPi / 2;
    profile.emplace_back(radius * std::cos(a), radius * std::sin(a));
  }
  profile.emplace_back(0, radius);
  return revolved(profile, n);
}
inline Mesh cone(int n, double low_radius, double high_radius, double height) {
  return revolved({{0, 0}, {low_radius, 0}, {high_radius, height}, {0, height}}, n);
}

/// Points of an arc about `centre` from one angle to another [rad], `steps` + 1 of them.
inline Outline arc(const Eigen::Vector2d& centre, double radius, double from, double to, int steps = 6) {
  Outline o;
  for (int k = 0; k <= steps; ++k) {
    const double a = from + (to - from) * k / steps;
    o.push_back(centre + radius * Eigen::Vector2d(std::cos(a), std::sin(a)));
  }
  return o;
}
inline Outline joined(const std::vector<Outline>& pieces) {
  Outline all;
  for (const Outline& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
  return all;
}
/// Rectangular block with rounded vertical edges whose top's rim is rounded, too.
inline Mesh blockWithRoundedTop(double x, double y, double height, double corner, double rim, int steps = 6) {
  Mesh m;
  Outline below = roundedRectangle(8, x, y, corner);
  cap(&m, below, 0, false);
  wall(&m, below, 0, height - rim);
  for (int k = 1; k <= steps; ++k) {
    const double low = kPi / 2 * (k - 1) / steps, high = kPi / 2 * k / steps;
    const double inset = rim * (1 - std::cos(high));
    const Outline above = roundedRectangle(8, x - 2 * inset, y - 2 * inset, corner - inset);
    const double z0 = height - rim * (1 - std::sin(low)), z1 = height - rim * (1 - std::sin(high));
    for (size_t i = 0; i < below.size(); ++i) {
      const size_t n = (i + 1) % below.size();
      quad(&m, at(below[i], z0), at(below[n], z0), at(above[n], z1), at(above[i], z1));
    }
    below = above;
  }
  cap(&m, below, height, true);
  return m;
}
/// Box whose edges are all rounded.
inline Mesh roundedBox(double x, double y, double z, double radius, int steps = 6) {
  const Point half = 0.5 * Point(x, y, z);
  const auto ticks = [&](double end) {
    std::vector<double> values;
    for (int k = 0; k <= steps; ++k) values.push_back(-end + radius * k / steps);
    for (int k = steps; k >= 0; --k) values.push_back(end - radius * k / steps);
    return values;
  };
  const auto pulledIn = [&](const Point& p) {
    const Point flat = half - Point::Constant(radius);
    const Point inner = p.cwiseMin(flat).cwiseMax(-flat);
    return Point(inner + radius * (p - inner).normalized());
  };

  Mesh m;
  for (int axis = 0; axis < 3; ++axis) {
    const int across = (axis + 1) % 3, up = (axis + 2) % 3;
    const std::vector<double> u = ticks(half[across]), v = ticks(half[up]);
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](size_t i, size_t k) {
        Point p;
        p[axis] = side * half[axis];
        p[across] = u[i];
        p[up] = v[k];
        return pulledIn(p);
      };
      for (size_t i = 0; i + 1 < u.size(); ++i)
        for (size_t k = 0; k + 1 < v.size(); ++k) {
          if (side > 0) quad(&m, corner(i, k), corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1));
          if (side < 0) quad(&m, corner(i, k), corner(i, k + 1), corner(i + 1, k + 1), corner(i + 1, k));
        }
    }
  }
  return m;
}

inline std::string shippedModel(const std::string& name) {
  return std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/models/" + name + ".ply";
}

/// What most files of these tests hold [mm].
inline const Mesh kBox = box(40, 50, 60);

}  // namespace monocular_eye_hand::shapes
