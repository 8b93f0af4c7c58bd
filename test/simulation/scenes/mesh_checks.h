#pragma once
#include <Eigen/Geometry>
#include <map>
#include <utility>

#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

inline double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return sum;
}

/// Every edge is used once in each direction.
inline bool closed(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges[{t[k], t[(k + 1) % 3]}]++;
  for (const auto& [edge, count] : edges)
    if (count != 1 || !edges.count({edge.second, edge.first})) return false;
  return true;
}

}  // namespace monocular_eye_hand
