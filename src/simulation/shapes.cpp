#include <fmt/format.h>

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {
namespace {

void requirePositive(double value, const char* what) {
  if (!(value > 0) || !std::isfinite(value))
    throw BadInput(fmt::format("synthetic shape: {} = {:g} must be positive", what, value));
}

// A surface of revolution about z: rings of (radius, z) from bottom to top; a radius of 0 closes it in a
// point.
Mesh revolve(const std::vector<Eigen::Vector2d>& profile, int segments) {
  if (segments < 3) throw BadInput(fmt::format("synthetic shape: segments = {} must be >= 3", segments));

  Mesh mesh;
  std::vector<int> first(profile.size());
  for (size_t k = 0; k < profile.size(); ++k) {
    first[k] = int(mesh.vertices.size());
    const int count = profile[k].x() > 0 ? segments : 1;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * M_PI * i / segments;
      mesh.vertices.emplace_back(profile[k].x() * std::cos(angle), profile[k].x() * std::sin(angle),
                                 profile[k].y());
    }
  }

  for (size_t k = 0; k + 1 < profile.size(); ++k)
    for (int i = 0; i < segments; ++i) {
      const int j = (i + 1) % segments;
      const bool low_point = profile[k].x() <= 0, high_point = profile[k + 1].x() <= 0;
      const int a = first[k] + (low_point ? 0 : i), b = first[k] + (low_point ? 0 : j);
      const int c = first[k + 1] + (high_point ? 0 : i), d = first[k + 1] + (high_point ? 0 : j);
      if (!low_point) mesh.triangles.push_back({a, b, d});
      if (!high_point) mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

}  // namespace

Mesh boxMesh(const Eigen::Vector3d& size) {
  for (int k = 0; k < 3; ++k) requirePositive(size[k], "box size");
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1 ? 0.5 : -0.5) * size.x(), (i & 2 ? 0.5 : -0.5) * size.y(),
                               (i & 4 ? 1.0 : 0.0) * size.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Mesh cylinderMesh(double radius, double height, int segments) {
  return coneMesh(radius, radius, height, segments);
}

Mesh coneMesh(double base_radius, double top_radius, double height, int segments) {
  requirePositive(base_radius, "base radius");
  requirePositive(height, "height");
  if (!(top_radius >= 0)) requirePositive(top_radius, "top radius");
  std::vector<Eigen::Vector2d> profile{{0, 0}, {base_radius, 0}};
  if (top_radius > 0) profile.emplace_back(top_radius, height);
  profile.emplace_back(0, height);
  return revolve(profile, segments);
}

Mesh sphereMesh(double radius, int rings) {
  requirePositive(radius, "sphere radius");
  if (rings < 2) throw BadInput(fmt::format("synthetic shape: rings = {} must be >= 2", rings));
  std::vector<Eigen::Vector2d> profile;
  for (int k = 0; k <= rings; ++k) {
    const double angle = M_PI * k / rings;
    const bool pole = k == 0 || k == rings;
    profile.emplace_back(pole ? 0 : radius * std::sin(angle), radius * (1 - std::cos(angle)));
  }
  return revolve(profile, 2 * rings);
}

Mesh quadMesh(double width, double depth) {
  requirePositive(width, "quad width");
  requirePositive(depth, "quad depth");
  const double x = width / 2, y = depth / 2;
  return {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace monocular_eye_hand
