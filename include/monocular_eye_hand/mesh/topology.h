#pragma once
#include <vector>

#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

/// An edge of the mesh. Triangle t0 runs it from a to b (so t0 lies on its left seen from outside), t1 from b
/// to a.
struct MeshEdge {
  int a = -1, b = -1;
  int t0 = -1, t1 = -1;  ///< t1 = -1 on a rim
  int uses = 0;          ///< triangles that share it: 1 on a rim, 2 on a clean solid
  double angle = 0;      ///< between the two normals [rad]
  bool convex = true;
};

/// A mesh with its edges, normals and areas.
struct Topology {
  std::vector<MeshEdge> edges;
  std::vector<std::array<int, 3>> edges_of_triangle;  ///< edge k runs from corner k to corner k + 1
  std::vector<Eigen::Vector3d> normals;               ///< unit, outward
  std::vector<double> areas;                          ///< [m^2]
};
Topology buildTopology(const Mesh& mesh);

/// True when every edge belongs to two triangles that run it in opposite directions; vertices at the same
/// place are one.
bool isClosed(const Mesh& mesh);

/// Largest distance between two vertices.
double meshDiameter(const std::vector<Eigen::Vector3d>& vertices);

}  // namespace monocular_eye_hand
