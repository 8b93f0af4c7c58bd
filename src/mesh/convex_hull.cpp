#include "mesh/convex_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace monocular_eye_hand {
namespace {

struct Face {
  std::array<int, 3> v;
  Eigen::Vector3d normal;
  double offset;
};

Face makeFace(const std::vector<Eigen::Vector3d>& p, int a, int b, int c) {
  Face face{{a, b, c}, (p[b] - p[a]).cross(p[c] - p[a]).normalized(), 0};
  face.offset = face.normal.dot(p[a]);
  return face;
}

template <typename Measure>
int largest(size_t count, const Measure& measure) {
  int best = 0;
  for (size_t k = 1; k < count; ++k)
    if (measure(k) > measure(best)) best = int(k);
  return best;
}

// Four points that span a volume; an empty list when there are none.
std::vector<int> firstTetrahedron(const std::vector<Eigen::Vector3d>& p) {
  const int a = largest(p.size(), [&](size_t k) { return p[k].x(); });
  const int b = largest(p.size(), [&](size_t k) { return (p[k] - p[a]).norm(); });
  const Eigen::Vector3d along = (p[b] - p[a]).normalized();
  const int c = largest(p.size(), [&](size_t k) { return (p[k] - p[a]).cross(along).norm(); });
  const Eigen::Vector3d normal = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
  const int d = largest(p.size(), [&](size_t k) { return std::abs((p[k] - p[a]).dot(normal)); });
  const double height = (p[d] - p[a]).dot(normal);
  if (!(std::abs(height) > 1e-6 * (p[b] - p[a]).norm())) return {};
  return height > 0 ? std::vector<int>{a, c, b, d} : std::vector<int>{a, b, c, d};
}

}  // namespace

std::vector<Eigen::Vector3d> hullNormals(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() < 4) return {};
  const std::vector<int> t = firstTetrahedron(points);
  if (t.empty()) return {};

  std::vector<Face> faces{makeFace(points, t[0], t[1], t[2]), makeFace(points, t[0], t[3], t[1]),
                          makeFace(points, t[1], t[3], t[2]), makeFace(points, t[2], t[3], t[0])};
  const double tolerance = 1e-10 * (points[t[0]] - points[t[1]]).norm();

  for (size_t k = 0; k < points.size(); ++k) {
    std::set<std::pair<int, int>> edges;  // of the faces that see the point
    std::vector<Face> kept;
    for (const Face& face : faces) {
      if (face.normal.dot(points[k]) - face.offset <= tolerance) {
        kept.push_back(face);
        continue;
      }
      for (int i = 0; i < 3; ++i) edges.insert({face.v[i], face.v[(i + 1) % 3]});
    }
    for (const auto& [from, to] : edges)
      if (!edges.count({to, from})) kept.push_back(makeFace(points, from, to, int(k)));
    faces.swap(kept);
  }

  std::vector<Eigen::Vector3d> normals;
  for (const Face& face : faces) normals.push_back(face.normal);
  return normals;
}

std::vector<Eigen::Vector2d> planarHull(std::vector<Eigen::Vector2d> points) {
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);

  std::vector<Eigen::Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const size_t base = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= base + 2) {
        const Eigen::Vector2d u = hull.back() - hull[hull.size() - 2], w = p - hull.back();
        if (u.x() * w.y() - u.y() * w.x() > 0) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();  // the first point of the other half
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace monocular_eye_hand
