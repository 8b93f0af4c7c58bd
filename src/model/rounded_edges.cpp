#include "model/rounded_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace monocular_eye_hand {
namespace {

constexpr double kMinTurn = 0.35;  // angle between the planes [rad]
constexpr double kMaxTurn = 2.6;   // ... at the round end of a slot it is pi
constexpr double kAlongAxis =
    0.999;                       // cosine between the wall's axis and the mesh edges that join it to a plane
constexpr double kJoined = 0.6;  // share of the wall's length along which a plane joins it
constexpr double kCrossing = 0.17;  // edges that meet in a corner differ by so much in direction [rad]
constexpr double kReach = 1.5;      // rounded edges end before their corner [radii]
constexpr double kMiss = 0.05;      // ... and pass each other at most so far there [radii]

// Along how much of its length each plane joins each cylinder wall smoothly [m].
std::map<int, std::map<int, double>> planesBesideWalls(const Mesh& mesh, const Topology& topology,
                                                       const SurfaceSplit& split) {
  std::map<int, std::map<int, double>> joined;
  const auto add = [&](int wall_index, int plane_index, const Eigen::Vector3d& edge) {
    const Surface &wall = split.surfaces[size_t(wall_index)], &plane = split.surfaces[size_t(plane_index)];
    if (wall.kind != Surface::Kind::kCylinder || plane.kind != Surface::Kind::kPlane) return;
    if (std::abs(edge.normalized().dot(wall.axis)) > kAlongAxis)
      joined[wall_index][plane_index] += edge.norm();
  };

  for (const SmoothBorder& border : smoothBorders(topology, split)) {
    const MeshEdge& e = *border.edge;
    const Eigen::Vector3d edge = mesh.vertices[size_t(e.b)] - mesh.vertices[size_t(e.a)];
    add(border.a, border.b, edge);
    add(border.b, border.a, edge);
  }
  return joined;
}

// The edge along the middle of a wall between two planes.
ModelEdge middleOf(const Surface& wall, const std::array<int, 2>& planes, const SurfaceSplit& split) {
  const Eigen::Vector3d n0 = split.surfaces[size_t(planes[0])].axis,
                        n1 = split.surfaces[size_t(planes[1])].axis;
  ModelEdge edge;
  edge.surface = planes;
  edge.normal = {n0, n1};
  edge.dihedral = std::atan2(n0.cross(n1).norm(), n0.dot(n1));
  edge.convex = wall.convex;
  edge.rounding = wall.radius;

  // Surface 0, on the left, runs away from a convex edge against the other's normal.
  Eigen::Vector3d along = wall.half_length * wall.axis;
  if ((n0.cross(along).dot(n1) < 0) != wall.convex) along = -along;
  const Eigen::Vector3d middle =
      wall.point + (wall.convex ? wall.radius : -wall.radius) * (n0 + n1).normalized();
  edge.p = middle - along;
  edge.q = middle + along;
  return edge;
}

// Where the lines of two edges meet, and which of their ends (0: p, 1: q) are near there.
struct Meeting {
  Eigen::Vector3d p;
  int end_a, end_b;
};
std::optional<Meeting> meetingOf(const ModelEdge& a, const ModelEdge& b) {
  const Eigen::Vector3d along_a = (a.q - a.p).normalized(), along_b = (b.q - b.p).normalized();
  const double cosine = along_a.dot(along_b), squared_sine = 1 - cosine * cosine;
  if (squared_sine < kCrossing * kCrossing) return std::nullopt;

  const Eigen::Vector3d apart = b.p - a.p;
  const Eigen::Vector3d on_a =
      a.p + (apart.dot(along_a) - cosine * apart.dot(along_b)) / squared_sine * along_a;
  const Eigen::Vector3d on_b =
      b.p + (cosine * apart.dot(along_a) - apart.dot(along_b)) / squared_sine * along_b;
  const double radius = std::max(a.rounding, b.rounding);
  if ((on_a - on_b).norm() > kMiss * radius) return std::nullopt;

  Meeting meeting{0.5 * (on_a + on_b), 0, 0};
  const auto nearestEnd = [&](const ModelEdge& e, int* end) {
    const double to_p = (meeting.p - e.p).norm(), to_q = (meeting.p - e.q).norm();
    *end = to_q < to_p;
    return std::min(to_p, to_q);
  };
  const double farthest = std::max(nearestEnd(a, &meeting.end_a), nearestEnd(b, &meeting.end_b));
  if (farthest > kReach * radius) return std::nullopt;
  return meeting;
}

// Makes two ends meet in one corner, the one that either has already, unless both have one.
void joinEnds(const Meeting& meeting, int a, int b, SharpFeatures* features) {
  int& corner_a = features->edges[size_t(a)].vertex[size_t(meeting.end_a)];
  int& corner_b = features->edges[size_t(b)].vertex[size_t(meeting.end_b)];
  if (corner_a >= 0 && corner_b >= 0) return;
  if (corner_a < 0 && corner_b < 0) {
    corner_a = corner_b = int(features->corners.size());
    features->corners.push_back({meeting.p, {a, b}});
    return;
  }
  const int corner = std::max(corner_a, corner_b);
  features->corners[size_t(corner)].edges.push_back(corner_a < 0 ? a : b);
  corner_a = corner_b = corner;
}

// Edges are seen to end where their lines meet, not where the walls between their planes do.
void reachCorners(size_t first, SharpFeatures* features) {
  for (size_t i = first; i < features->edges.size(); ++i) {
    ModelEdge& edge = features->edges[i];
    if (edge.vertex[0] >= 0) edge.p = features->corners[size_t(edge.vertex[0])].p;
    if (edge.vertex[1] >= 0) edge.q = features->corners[size_t(edge.vertex[1])].p;
  }
}

}  // namespace

std::vector<ModelEdge> findRoundedEdges(const Mesh& mesh, const Topology& topology, const SurfaceSplit& split,
                                        double diameter) {
  std::vector<ModelEdge> found;
  for (const auto& [wall_index, planes] : planesBesideWalls(mesh, topology, split)) {
    const Surface& wall = split.surfaces[size_t(wall_index)];
    std::vector<int> beside;
    for (const auto& [plane, length] : planes)
      if (length > kJoined * 2 * wall.half_length) beside.push_back(plane);
    if (beside.size() != 2) continue;

    const ModelEdge edge = middleOf(wall, {beside[0], beside[1]}, split);
    const bool turns_as_edges_do = edge.dihedral > kMinTurn && edge.dihedral < kMaxTurn;
    if (turns_as_edges_do && edge.dihedral * edge.rounding < kWidestRound * diameter) found.push_back(edge);
  }
  return found;
}

void addRoundedEdges(const std::vector<ModelEdge>& rounded, SharpFeatures* features) {
  const size_t first = features->edges.size();
  for (const ModelEdge& edge : rounded) {
    const size_t added = features->edges.size();
    features->edges.push_back(edge);
    for (size_t other = first; other < added; ++other)
      if (const auto meeting = meetingOf(edge, features->edges[other]))
        joinEnds(*meeting, int(added), int(other), features);
  }
  reachCorners(first, features);
}

}  // namespace monocular_eye_hand
