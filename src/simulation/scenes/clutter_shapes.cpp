#include "simulation/scenes/clutter_shapes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

void require(bool ok, const std::string& what) {
  if (!ok) throw BadInput("clutter shape: " + what);
}

}  // namespace

Mesh turnedMesh(const std::vector<Eigen::Vector2d>& profile, int segments) {
  require(profile.size() >= 3, "a profile has at least three points");
  require(segments >= 3, "segments must be >= 3");
  const bool ring = profile.front().x() > 0 && profile.back().x() > 0;
  Mesh mesh;
  std::vector<int> first;
  for (const Eigen::Vector2d& point : profile) {
    require(point.x() >= 0, "a profile's radius must not be negative");
    first.push_back(int(mesh.vertices.size()));
    const int count = point.x() > 0 ? segments : 1;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * M_PI * i / segments;
      mesh.vertices.emplace_back(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y());
    }
  }

  const size_t bands = ring ? profile.size() : profile.size() - 1;
  for (size_t k = 0; k < bands; ++k) {
    const size_t next = (k + 1) % profile.size();
    const bool low_point = profile[k].x() <= 0, high_point = profile[next].x() <= 0;
    for (int i = 0; i < segments; ++i) {
      const int j = (i + 1) % segments;
      const int a = first[k] + (low_point ? 0 : i), b = first[k] + (low_point ? 0 : j);
      const int c = first[next] + (high_point ? 0 : i), d = first[next] + (high_point ? 0 : j);
      if (!low_point) mesh.triangles.push_back({a, b, d});
      if (!high_point) mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

Mesh ringMesh(double outer_radius, double inner_radius, double height, int segments) {
  require(inner_radius > 0 && outer_radius > inner_radius && height > 0,
          "a ring needs 0 < inner < outer radius and a height");
  return turnedMesh({{inner_radius, 0}, {outer_radius, 0}, {outer_radius, height}, {inner_radius, height}},
                    segments);
}

Mesh screwMesh(double head_radius, double head_height, double shank_radius, double length) {
  require(shank_radius > 0 && head_radius > shank_radius && head_height > 0 && length > 0,
          "a screw needs 0 < shank < head radius, a head height and a length");
  const double tip = -(head_height + length);
  return turnedMesh({{0, tip},
                     {shank_radius, tip},
                     {shank_radius, -head_height},
                     {head_radius, -head_height},
                     {head_radius, 0},
                     {0, 0}});
}

Mesh angleMesh(double leg_x, double leg_z, double thickness, double length) {
  require(thickness > 0 && leg_x > thickness && leg_z > thickness && length > 0,
          "an angle section needs legs longer than its thickness");
  // Counter-clockwise in the plane (x, z), from the inner corner: a fan about it stays inside.
  const double t = thickness;
  const std::vector<Eigen::Vector2d> section{{t, t}, {t, leg_z}, {0, leg_z}, {0, 0}, {leg_x, 0}, {leg_x, t}};
  const int n = int(section.size());

  Mesh mesh;
  for (const double y : {-0.5 * length, 0.5 * length})
    for (const Eigen::Vector2d& p : section) mesh.vertices.emplace_back(p.x(), y, p.y());

  for (int k = 1; k + 1 < n; ++k) {
    mesh.triangles.push_back({0, k, k + 1});
    mesh.triangles.push_back({n, n + k + 1, n + k});
  }

  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    mesh.triangles.push_back({k, n + next, next});
    mesh.triangles.push_back({k, n + k, n + next});
  }
  return mesh;
}

Mesh trayMesh(const Eigen::Vector3d& size, double wall) {
  require(wall > 0 && size.x() > 2 * wall && size.y() > 2 * wall && size.z() > wall,
          "a tray must be larger than its walls");

  Mesh mesh;
  const auto corners = [&](double x, double y, double z) {  // counter-clockwise seen from above
    mesh.vertices.insert(mesh.vertices.end(), {{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}});
  };
  const double x = size.x() / 2, y = size.y() / 2;
  corners(x, y, 0);                       // 0: underside
  corners(x, y, size.z());                // 4: outer rim
  corners(x - wall, y - wall, size.z());  // 8: inner rim
  corners(x - wall, y - wall, wall);      // 12: floor

  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {12, 13, 14}, {12, 14, 15}};
  for (const int base : {0, 4, 8})
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      mesh.triangles.push_back({base + k, base + next, base + 4 + next});
      mesh.triangles.push_back({base + k, base + 4 + next, base + 4 + k});
    }
  return mesh;
}

Mesh cableMesh(const std::vector<Eigen::Vector3d>& path, double radius, int segments) {
  require(path.size() >= 2, "a cable's path has at least two points");
  require(radius > 0 && segments >= 3, "a cable needs a radius and at least three segments");
  Mesh mesh;
  Eigen::Vector3d x = (path[1] - path[0]).unitOrthogonal();
  for (size_t k = 0; k < path.size(); ++k) {
    const Eigen::Vector3d along =
        (path[std::min(k + 1, path.size() - 1)] - path[k > 0 ? k - 1 : 0]).normalized();
    x = (x - x.dot(along) * along).normalized();  // carried along without twist
    const Eigen::Vector3d y = along.cross(x);
    for (int i = 0; i < segments; ++i) {
      const double angle = 2 * M_PI * i / segments;
      mesh.vertices.push_back(path[k] + radius * (std::cos(angle) * x + std::sin(angle) * y));
    }
  }

  const int last = segments * int(path.size() - 1);
  for (int ring = 0; ring < last; ring += segments)
    for (int i = 0; i < segments; ++i) {
      const int j = (i + 1) % segments;
      mesh.triangles.push_back({ring + i, ring + j, ring + segments + j});
      mesh.triangles.push_back({ring + i, ring + segments + j, ring + segments + i});
    }
  for (int i = 1; i + 1 < segments; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({last, last + i, last + i + 1});
  }
  return mesh;
}

}  // namespace monocular_eye_hand
