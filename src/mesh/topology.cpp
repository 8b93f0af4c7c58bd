#include "monocular_eye_hand/mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace monocular_eye_hand {
namespace {

/// One triangle's use of an edge, ordered so that equal edges stand together.
struct Use {
  int low, high, triangle, corner;
  bool operator<(const Use& o) const {
    return std::tie(low, high, triangle, corner) < std::tie(o.low, o.high, o.triangle, o.corner);
  }
};

void addEdge(const Mesh& mesh, const std::vector<Use>& uses, size_t begin, size_t end, Topology* out) {
  MeshEdge edge;
  edge.uses = int(end - begin);
  const auto from = [&](const Use& u) { return mesh.triangles[u.triangle][u.corner]; };
  edge.t0 = uses[begin].triangle;
  edge.a = from(uses[begin]);
  edge.b = edge.a == uses[begin].low ? uses[begin].high : uses[begin].low;

  for (size_t k = begin + 1; k < end && edge.t1 < 0; ++k) {
    if (from(uses[k]) != edge.a) edge.t1 = uses[k].triangle;
  }
  if (edge.t1 < 0 && edge.uses > 1) edge.t1 = uses[begin + 1].triangle;

  if (edge.t1 >= 0) {
    const Eigen::Vector3d &n0 = out->normals[edge.t0], &n1 = out->normals[edge.t1];
    edge.angle = std::atan2(n0.cross(n1).norm(), n0.dot(n1));
    const Eigen::Vector3d along = mesh.vertices[edge.b] - mesh.vertices[edge.a];
    edge.convex = n0.cross(n1).dot(along) >= 0;
  }

  for (size_t k = begin; k < end; ++k) {
    out->edges_of_triangle[uses[k].triangle][uses[k].corner] = int(out->edges.size());
  }
  out->edges.push_back(edge);
}

using Directed = std::array<int, 2>;

/// Numbers of the vertices under which vertices at the same place are one.
std::vector<int> mergedNumbers(const std::vector<Eigen::Vector3d>& vertices) {
  std::vector<int> order(vertices.size()), number(vertices.size());
  for (size_t k = 0; k < order.size(); ++k) order[k] = int(k);
  const auto less = [&](int i, int j) {
    const Eigen::Vector3d &a = vertices[i], &b = vertices[j];
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::sort(order.begin(), order.end(), less);
  for (size_t k = 0; k < order.size(); ++k)
    number[order[k]] = k > 0 && !less(order[k - 1], order[k]) ? number[order[k - 1]] : int(k);
  return number;
}

}  // namespace

Topology buildTopology(const Mesh& mesh) {
  Topology out;
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& tri = mesh.triangles[t];
    const Eigen::Vector3d normal =
        (mesh.vertices[tri[1]] - mesh.vertices[tri[0]]).cross(mesh.vertices[tri[2]] - mesh.vertices[tri[0]]);
    out.areas.push_back(0.5 * normal.norm());
    out.normals.push_back(normal.normalized());
    for (int c = 0; c < 3; ++c) {
      const int a = tri[c], b = tri[(c + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), int(t), c});
    }
  }

  std::sort(uses.begin(), uses.end());
  out.edges_of_triangle.resize(mesh.triangles.size());
  for (size_t begin = 0; begin < uses.size();) {
    size_t end = begin + 1;
    while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) ++end;
    addEdge(mesh, uses, begin, end, &out);
    begin = end;
  }
  return out;
}

double meshDiameter(const std::vector<Eigen::Vector3d>& vertices) {
  if (vertices.empty()) return 0;
  const auto farthest = [&](const Eigen::Vector3d& from) {
    size_t best = 0;
    for (size_t k = 1; k < vertices.size(); ++k) {
      if ((vertices[k] - from).squaredNorm() > (vertices[best] - from).squaredNorm()) best = k;
    }
    return best;
  };

  // A good lower bound first; then only vertices that could beat it are compared with each other.
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : vertices) box.extend(v);
  size_t a = farthest(box.center()), b = farthest(vertices[a]);
  double best = (vertices[a] - vertices[b]).norm();
  for (int round = 0; round < 3; ++round) {
    a = farthest(vertices[b]);
    best = std::max(best, (vertices[a] - vertices[b]).norm());
    std::swap(a, b);
  }

  std::vector<Eigen::Vector3d> candidates;
  for (const Eigen::Vector3d& v : vertices) {
    const Eigen::Vector3d reach = (v - box.min()).cwiseMax(box.max() - v);
    if (reach.norm() > best) candidates.push_back(v);
  }

  constexpr size_t kMaxCompared = 20000;  // beyond, every n-th is compared: the bound above is already close
  const size_t stride = 1 + candidates.size() / kMaxCompared;
  for (size_t i = 0; i < candidates.size(); i += stride) {
    for (size_t j = 0; j < i; j += stride) best = std::max(best, (candidates[i] - candidates[j]).norm());
  }
  return best;
}

bool isClosed(const Mesh& mesh) {
  const std::vector<int> number = mergedNumbers(mesh.vertices);
  std::vector<Directed> edges, reversed;
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = number[t[k]], b = number[t[(k + 1) % 3]];
      if (a == b) continue;
      edges.push_back({a, b});
      reversed.push_back({b, a});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(reversed.begin(), reversed.end());
  return !edges.empty() && edges == reversed;
}

}  // namespace monocular_eye_hand
