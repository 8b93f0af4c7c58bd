#include "simulation/render/rounded_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "monocular_eye_hand/mesh/ray_tracer.h"

namespace monocular_eye_hand {
namespace {

constexpr float kRoundedCosine = 0.94f;  // as in cornerNormals(): below 20 degrees it is a curved surface
constexpr float kFoldCosine = -0.9f;     // thinner than a blade: no radius fits

using Position = std::array<double, 3>;

Position positionOf(const Mesh& mesh, int vertex) {
  const Eigen::Vector3d& p = mesh.vertices[size_t(vertex)];
  return {p.x(), p.y(), p.z()};
}

// By position, not by index: a mesh need not be welded.
std::vector<int> weldedVertices(const Mesh& mesh) {
  std::map<Position, int> first;
  std::vector<int> welded(mesh.vertices.size());
  for (size_t v = 0; v < mesh.vertices.size(); ++v)
    welded[v] = first.emplace(positionOf(mesh, int(v)), int(v)).first->second;
  return welded;
}

}  // namespace

RoundedEdges::RoundedEdges(const Mesh& mesh, const Rigid3& world_from_mesh, double radius) {
  const std::vector<int> welded = weldedVertices(mesh);
  std::vector<Eigen::Vector3f> points, normals;
  for (const Eigen::Vector3d& p : mesh.vertices) points.push_back((world_from_mesh * p).cast<float>());
  for (const auto& t : mesh.triangles)
    normals.push_back((points[size_t(t[1])] - points[size_t(t[0])])
                          .cross(points[size_t(t[2])] - points[size_t(t[0])])
                          .normalized());

  struct Sides {
    int triangle = -1, opposite = -1;
  };
  std::map<std::pair<int, int>, Sides> open;
  std::vector<std::vector<int>> at_vertex(mesh.vertices.size());
  std::vector<std::array<Eigen::Vector3f, 2>> sides;  // normals of each edge's two faces
  for (size_t k = 0; k < mesh.triangles.size(); ++k)
    for (int side = 0; side < 3; ++side) {
      const int a = welded[size_t(mesh.triangles[k][size_t(side)])];
      const int b = welded[size_t(mesh.triangles[k][size_t((side + 1) % 3)])];
      const int opposite = mesh.triangles[k][size_t((side + 2) % 3)];
      const auto key = std::minmax(a, b);
      const auto found = open.find(key);
      if (found == open.end()) {
        open[key] = {int(k), opposite};
        continue;
      }
      const Eigen::Vector3f &n = normals[k], &m = normals[size_t(found->second.triangle)];
      const float cosine = n.dot(m);
      open.erase(found);
      if (!(cosine < kRoundedCosine && cosine > kFoldCosine) || a == b) continue;

      Edge edge;
      edge.p = points[size_t(a)];
      edge.along = points[size_t(b)] - edge.p;
      edge.length = edge.along.norm();
      edge.along /= std::max(edge.length, 1e-12f);
      edge.middle = (n + m).normalized();
      const float half_angle = 0.5f * std::acos(cosine);
      edge.width = float(radius) * std::min(2.0f, std::tan(half_angle));
      edge.convex = (points[size_t(opposite)] - edge.p).dot(m) < 0;
      at_vertex[size_t(a)].push_back(int(edges_.size()));
      at_vertex[size_t(b)].push_back(int(edges_.size()));
      edges_.push_back(edge);
      sides.push_back({n, m});
    }

  // An edge belongs to its two triangles and to those that meet it in a vertex only, if on the same face.
  for (size_t k = 0; k < mesh.triangles.size(); ++k) {
    first_.push_back(int(near_.size()));
    for (const int vertex : mesh.triangles[k])
      for (const int edge : at_vertex[size_t(welded[size_t(vertex)])]) {
        const auto& normal = sides[size_t(edge)];
        if (std::max(normal[0].dot(normals[k]), normal[1].dot(normals[k])) < kRoundedCosine) continue;
        if (std::find(near_.begin() + first_.back(), near_.end(), edge) == near_.end()) near_.push_back(edge);
      }
  }
  first_.push_back(int(near_.size()));
}

Eigen::Vector3f RoundedEdges::closestPoint(const Edge& edge, const Eigen::Vector3f& p) const {
  const float along = std::clamp((p - edge.p).dot(edge.along), 0.0f, edge.length);
  return edge.p + along * edge.along;
}

RoundedEdges::Bend RoundedEdges::bend(uint32_t triangle, const Eigen::Vector3f& p,
                                      const Eigen::Vector3f& normal) const {
  Bend out{false, normal, p};
  if (first_.empty()) return out;
  float nearest = 1;
  for (int k = first_[triangle]; k < first_[triangle + 1]; ++k) {
    const Edge& edge = edges_[size_t(near_[size_t(k)])];
    const Eigen::Vector3f foot = closestPoint(edge, p);
    const float relative = (p - foot).norm() / edge.width;
    if (!(relative < 1)) continue;
    out.bent = true;
    out.normal += (1 - relative) * (edge.middle - normal);
    if (relative > nearest) continue;
    nearest = relative;
    out.origin = foot + 5 * kRayLift * edge.middle;
  }
  if (out.bent) out.normal.normalize();
  return out;
}

float RoundedEdges::nearness(uint32_t triangle, const Eigen::Vector3f& p, float width) const {
  float max_nearness = 0;
  if (first_.empty()) return max_nearness;
  for (int k = first_[triangle]; k < first_[triangle + 1]; ++k) {
    const Edge& edge = edges_[size_t(near_[size_t(k)])];
    if (edge.convex) max_nearness = std::max(max_nearness, 1 - (p - closestPoint(edge, p)).norm() / width);
  }
  return max_nearness;
}

}  // namespace monocular_eye_hand
