#include "model/contour_index.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace monocular_eye_hand {
namespace {

constexpr double kStartShare = 0.003;  // of the diameter: visibility rays begin this far outside

double wrapped(double angle) { return angle - 2 * M_PI * std::round(angle / (2 * M_PI)); }

}  // namespace

ContourIndex::ContourIndex(const ObjectModel& model, const Topology& topology, const std::vector<char>& sharp)
    : start(kStartShare * model.diameter) {
  for (size_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    // A hole's wall never shows a silhouette: the rays that touch it run inside the material.
    if (surface.kind == Surface::Kind::kCylinder && surface.convex) addWall(model, int(s));
    if (surface.kind == Surface::Kind::kFreeform) addPatch(model, topology, sharp, int(s));
  }
}

void ContourIndex::addWall(const ObjectModel& model, int surface) {
  const Surface& s = model.surfaces[surface];
  CylinderWall wall;
  wall.feature = model.featureOfSilhouette(surface);
  wall.point = s.point;
  wall.axis = s.axis;
  wall.x = s.axis.unitOrthogonal();
  wall.y = s.axis.cross(wall.x);
  wall.radius = s.radius;
  wall.start = start;

  for (const int t : s.triangles) {
    CylinderWall::Triangle out;
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d d = model.mesh.vertices[model.mesh.triangles[t][c]] - s.point;
      const double angle = std::atan2(d.dot(wall.y), d.dot(wall.x));
      out.angle[c] = c == 0 ? angle : out.angle[0] + wrapped(angle - out.angle[0]);
      out.height[c] = d.dot(s.axis);
    }
    out.low = std::min({out.angle[0], out.angle[1], out.angle[2]});
    out.high = std::max({out.angle[0], out.angle[1], out.angle[2]});
    wall.triangles.push_back(out);
  }

  walls.push_back(std::move(wall));
}

void CylinderWall::cover(double angle, std::vector<HeightRange>* out) const {
  out->clear();
  constexpr double kSlack = 1e-9;
  for (const Triangle& t : triangles) {
    double a = angle;
    if (a < t.low - kSlack) a += 2 * M_PI;
    if (a > t.high + kSlack) a -= 2 * M_PI;
    if (a < t.low - kSlack || a > t.high + kSlack) continue;
    double low = 1e300, high = -1e300;
    for (int c = 0; c < 3; ++c) {
      const double a0 = t.angle[c], a1 = t.angle[(c + 1) % 3], h0 = t.height[c], h1 = t.height[(c + 1) % 3];
      if ((a0 - a > kSlack && a1 - a > kSlack) || (a - a0 > kSlack && a - a1 > kSlack)) continue;
      if (std::abs(a1 - a0) <= kSlack) {
        low = std::min({low, h0, h1});
        high = std::max({high, h0, h1});
        continue;
      }
      const double h = h0 + (h1 - h0) * std::clamp((a - a0) / (a1 - a0), 0.0, 1.0);
      low = std::min(low, h);
      high = std::max(high, h);
    }
    if (high > low) out->push_back({low, high});
  }

  std::sort(out->begin(), out->end(),
            [](const HeightRange& p, const HeightRange& q) { return p.low < q.low; });
  size_t kept = 0;
  const double gap = 1e-6 * radius;
  for (size_t k = 1; k < out->size(); ++k) {
    if ((*out)[k].low <= (*out)[kept].high + gap) {
      (*out)[kept].high = std::max((*out)[kept].high, (*out)[k].high);
    } else {
      (*out)[++kept] = (*out)[k];
    }
  }
  if (!out->empty()) out->resize(kept + 1);
}

namespace {

constexpr double kPointed = 0.5;  // between the facets at a point and their mean normal, at least [rad]

/// Mean normals of a surface at its vertices, weighted by the angles of the corners: they do not depend on
/// how faces were cut into triangles.
std::map<int, Eigen::Vector3d> meanNormals(const ObjectModel& model, const Topology& topology, int surface) {
  std::map<int, Eigen::Vector3d> normals;
  for (const int t : model.surfaces[surface].triangles) {
    const auto& corners = model.mesh.triangles[t];
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d& p = model.mesh.vertices[corners[c]];
      const Eigen::Vector3d a = model.mesh.vertices[corners[(c + 1) % 3]] - p;
      const Eigen::Vector3d b = model.mesh.vertices[corners[(c + 2) % 3]] - p;
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
      normals.emplace(corners[c], Eigen::Vector3d::Zero()).first->second += angle * topology.normals[t];
    }
  }
  for (auto& [vertex, normal] : normals) normal.normalize();
  return normals;
}

/// Vertices at which the surface comes to a point: all of it there is far from facing their mean normal.
std::set<int> pointsOf(const ObjectModel& model, const Topology& topology, int surface,
                       const std::map<int, Eigen::Vector3d>& mean_normals) {
  std::set<int> pointed;
  for (const auto& [vertex, normal] : mean_normals) pointed.insert(vertex);
  for (const int t : model.surfaces[surface].triangles)
    for (const int v : model.mesh.triangles[t])
      if (mean_normals.at(v).dot(topology.normals[t]) > std::cos(kPointed)) pointed.erase(v);
  return pointed;
}

/// Where a patch runs smoothly into a plane or a cylinder it takes that surface's exact normal.
void takeExactNormals(const ObjectModel& model, const Topology& topology, const std::vector<char>& sharp,
                      int surface, std::map<int, Eigen::Vector3d>* normals) {
  for (size_t k = 0; k < topology.edges.size(); ++k) {
    const MeshEdge& e = topology.edges[k];
    if (sharp[k] || e.uses != 2) continue;
    const int s0 = model.surface_of_triangle[e.t0], s1 = model.surface_of_triangle[e.t1];
    if (s0 == s1 || (s0 != surface && s1 != surface)) continue;
    const Surface& other = model.surfaces[s0 == surface ? s1 : s0];
    for (const int v : {e.a, e.b}) {
      Eigen::Vector3d& n = normals->at(v);
      if (other.kind == Surface::Kind::kPlane) n = other.axis;
      if (other.kind == Surface::Kind::kCylinder) {
        const Eigen::Vector3d d = model.mesh.vertices[v] - other.point;
        n = (other.convex ? 1 : -1) * (d - other.axis * other.axis.dot(d)).normalized();
      }
    }
  }
}

/// Mean normal of the surface's triangles at an edge.
Eigen::Vector3d normalAtEdge(const ObjectModel& model, const Topology& topology, int surface, int edge) {
  const MeshEdge& e = topology.edges[edge];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int t : {e.t0, e.t1})
    if (t >= 0 && model.surface_of_triangle[t] == surface) sum += topology.normals[t];
  return sum.normalized();
}

}  // namespace

void ContourIndex::addPatch(const ObjectModel& model, const Topology& topology,
                            const std::vector<char>& sharp, int surface) {
  FreeformPatch patch;
  patch.feature = model.featureOfSilhouette(surface);
  // The line lies on the triangles or a little inside the true surface: rays must clear the bulge of the
  // facets.
  patch.start = std::max(start, 2.5 * model.tessellation_error);

  std::map<int, Eigen::Vector3d> normals = meanNormals(model, topology, surface);
  const std::set<int> pointed = pointsOf(model, topology, surface, normals);
  takeExactNormals(model, topology, sharp, surface, &normals);
  std::map<std::pair<int, int>, int> nodes;
  const auto node = [&](int vertex, int edge) {
    const bool own = pointed.count(vertex) > 0;
    const auto [it, is_new] = nodes.emplace(std::make_pair(vertex, own ? edge : -1), int(nodes.size()));
    if (is_new) {
      patch.points.push_back(model.mesh.vertices[vertex]);
      patch.normals.push_back(own ? normalAtEdge(model, topology, surface, edge) : normals.at(vertex));
    }
    return it->second;
  };

  std::map<int, int> local_edge;
  for (const int t : model.surfaces[surface].triangles) {
    FreeformPatch::Triangle out;
    const auto& corners = model.mesh.triangles[t];
    for (int c = 0; c < 3; ++c) {
      const int edge = topology.edges_of_triangle[t][c];
      out.begin[c] = node(corners[c], edge);
      out.end[c] = node(corners[(c + 1) % 3], edge);
      out.edge[c] = local_edge.emplace(edge, int(local_edge.size())).first->second;
    }
    patch.triangles.push_back(out);
  }
  patch.edge_count = int(local_edge.size());
  patches.push_back(std::move(patch));
}

std::vector<Polyline> silhouetteLines(const FreeformPatch& patch, const Eigen::Vector3d& eye) {
  struct Segment {
    int edge[2];
    Eigen::Vector3d point[2], normal[2];
  };

  std::vector<double> side(patch.points.size());
  for (size_t k = 0; k < patch.points.size(); ++k) {
    side[k] = patch.normals[k].dot(eye - patch.points[k]);
    if (side[k] == 0) side[k] = 1e-300;
  }

  std::vector<Segment> segments;
  std::vector<std::pair<int, int>> at_edge;  // (edge, segment)
  int points_crossed = 0;
  for (const auto& t : patch.triangles) {
    Segment s;
    int found = 0;
    const auto cross = [&](int a, int b, int edge) {
      if ((side[a] > 0) == (side[b] > 0)) return;
      if (found < 2) {
        const double share = side[a] / (side[a] - side[b]);
        s.edge[found] = edge;
        s.point[found] = patch.points[a] + share * (patch.points[b] - patch.points[a]);
        s.normal[found] = (patch.normals[a] + share * (patch.normals[b] - patch.normals[a])).normalized();
      }
      ++found;
    };
    for (int c = 0; c < 3; ++c) {
      cross(t.begin[c], t.end[c], t.edge[c]);
      // Through the point itself, where the line ends.
      const int next = t.begin[(c + 1) % 3];
      if (t.end[c] != next) cross(t.end[c], next, patch.edge_count + points_crossed++);
    }
    if (found != 2) continue;
    at_edge.emplace_back(s.edge[0], int(segments.size()));
    at_edge.emplace_back(s.edge[1], int(segments.size()));
    segments.push_back(s);
  }

  std::sort(at_edge.begin(), at_edge.end());
  std::vector<char> used(segments.size(), 0);
  const auto next = [&](int edge) {
    for (auto it = std::lower_bound(at_edge.begin(), at_edge.end(), std::make_pair(edge, -1));
         it != at_edge.end() && it->first == edge; ++it) {
      if (!used[it->second]) return it->second;
    }
    return -1;
  };
  const auto degree = [&](int edge) {
    const auto it = std::lower_bound(at_edge.begin(), at_edge.end(), std::make_pair(edge, -1));
    return (it + 1 != at_edge.end() && (it + 1)->first == edge) ? 2 : 1;
  };

  std::vector<Polyline> lines;
  const auto walk = [&](int first, int from) {
    Polyline line;
    const auto push = [&](const Segment& s, int end) {
      line.points.push_back(s.point[end]);
      line.normals.push_back(s.normal[end]);
    };
    push(segments[first], from);
    for (int s = first, in = from; s >= 0;) {
      used[s] = 1;
      push(segments[s], 1 - in);
      const int edge = segments[s].edge[1 - in];
      s = next(edge);
      if (s >= 0) in = segments[s].edge[0] == edge ? 0 : 1;
    }
    lines.push_back(std::move(line));
  };

  for (size_t s = 0; s < segments.size(); ++s) {
    for (int end = 0; end < 2; ++end) {
      if (!used[s] && degree(segments[s].edge[end]) == 1) walk(int(s), end);
    }
  }
  for (size_t s = 0; s < segments.size(); ++s) {
    if (!used[s]) walk(int(s), 0);
  }
  return lines;
}

}  // namespace monocular_eye_hand
