#include "monocular_eye_hand/mesh/repair_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <map>
#include <tuple>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/topology.h"

namespace monocular_eye_hand {
namespace {

using Triangle = std::array<int, 3>;

/// Replaces vertices nearer than `tolerance` to an earlier one by that one, and drops unused vertices.
void weld(Mesh* mesh, double tolerance) {
  const double cell = 2 * tolerance;
  using Key = std::tuple<long long, long long, long long>;
  const auto key = [&](const Eigen::Vector3d& p, int dx, int dy, int dz) {
    return Key((long long)(std::floor(p.x() / cell)) + dx, (long long)(std::floor(p.y() / cell)) + dy,
               (long long)(std::floor(p.z() / cell)) + dz);
  };

  std::vector<std::pair<Key, int>> table;
  for (size_t k = 0; k < mesh->vertices.size(); ++k)
    table.emplace_back(key(mesh->vertices[k], 0, 0, 0), int(k));
  std::sort(table.begin(), table.end());

  std::vector<int> representative(mesh->vertices.size(), -1);
  for (size_t k = 0; k < mesh->vertices.size(); ++k) {
    if (representative[k] >= 0) continue;
    representative[k] = int(k);
    const Eigen::Vector3d& p = mesh->vertices[k];
    const Eigen::Vector3d in_cell = p / cell - (p / cell).array().floor().matrix();
    // The cell is twice the tolerance wide: only the nearer neighbour on each axis can hold a close vertex.
    const int s[3] = {in_cell.x() < 0.5 ? -1 : 1, in_cell.y() < 0.5 ? -1 : 1, in_cell.z() < 0.5 ? -1 : 1};
    for (int n = 0; n < 8; ++n) {
      const Key at = key(p, n & 1 ? s[0] : 0, n & 2 ? s[1] : 0, n & 4 ? s[2] : 0);
      for (auto it = std::lower_bound(table.begin(), table.end(), std::make_pair(at, int(k)));
           it != table.end() && it->first == at; ++it) {
        int& r = representative[it->second];
        if (r < 0 && (mesh->vertices[it->second] - p).norm() <= tolerance) r = int(k);
      }
    }
  }

  std::vector<int> renumbered(mesh->vertices.size(), -1);
  std::vector<Eigen::Vector3d> kept;
  for (Triangle& t : mesh->triangles) {
    for (int& v : t) {
      const int r = representative[v];
      if (renumbered[r] < 0) {
        renumbered[r] = int(kept.size());
        kept.push_back(mesh->vertices[r]);
      }
      v = renumbered[r];
    }
  }
  mesh->vertices = std::move(kept);
}

double height(const Mesh& mesh, const Triangle& t) {
  const Eigen::Vector3d a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return longest > 0 ? (b - a).cross(c - a).norm() / longest : 0;
}

/// Drops triangles without area and second copies of a triangle; returns how many had no area.
int dropDegenerate(Mesh* mesh, double tolerance) {
  int dropped = 0;
  std::vector<Triangle> kept;
  std::vector<std::pair<Triangle, int>> sorted;
  for (const Triangle& t : mesh->triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || height(*mesh, t) < tolerance) {
      ++dropped;
      continue;
    }
    Triangle s = t;
    std::sort(s.begin(), s.end());
    sorted.emplace_back(s, int(kept.size()));
    kept.push_back(t);
  }

  std::sort(sorted.begin(), sorted.end());
  std::vector<char> copy(kept.size(), 0);
  for (size_t k = 1; k < sorted.size(); ++k) copy[sorted[k].second] = sorted[k].first == sorted[k - 1].first;

  mesh->triangles.clear();
  for (size_t k = 0; k < kept.size(); ++k) {
    if (!copy[k]) mesh->triangles.push_back(kept[k]);
  }
  return dropped;
}

/// Splits triangles at rim vertices that lie inside one of their rim edges, as CAD exporters leave them where
/// faces are tessellated apart and as dropping a triangle without area does. Returns how many it split.
int closeTJunctions(Mesh* mesh, double tolerance) {
  const Topology topology = buildTopology(*mesh);
  std::vector<int> rim_vertices;
  for (const MeshEdge& e : topology.edges) {
    if (e.uses == 1) rim_vertices.insert(rim_vertices.end(), {e.a, e.b});
  }
  std::sort(rim_vertices.begin(), rim_vertices.end());
  rim_vertices.erase(std::unique(rim_vertices.begin(), rim_vertices.end()), rim_vertices.end());
  const auto x = [&](int v) { return mesh->vertices[v].x(); };
  std::sort(rim_vertices.begin(), rim_vertices.end(),
            [&](int a, int b) { return std::make_pair(x(a), a) < std::make_pair(x(b), b); });

  std::vector<char> touched(mesh->triangles.size(), 0);
  int splits = 0;
  for (const MeshEdge& e : topology.edges) {
    if (e.uses != 1 || touched[e.t0]) continue;
    const Eigen::Vector3d a = mesh->vertices[e.a], d = mesh->vertices[e.b] - a;
    const double length = d.norm();
    const double low = std::min(x(e.a), x(e.b)) - tolerance, high = std::max(x(e.a), x(e.b)) + tolerance;

    std::vector<std::pair<double, int>> inside;
    for (auto it = std::lower_bound(rim_vertices.begin(), rim_vertices.end(), low,
                                    [&](int v, double value) { return x(v) < value; });
         it != rim_vertices.end() && x(*it) <= high; ++it) {
      if (*it == e.a || *it == e.b) continue;
      const double s = d.dot(mesh->vertices[*it] - a) / length;
      if (s < 2 * tolerance || s > length - 2 * tolerance) continue;
      if ((mesh->vertices[*it] - a - d * (s / length)).norm() <= tolerance) inside.emplace_back(s, *it);
    }
    if (inside.empty()) continue;

    std::sort(inside.begin(), inside.end());
    touched[e.t0] = 1;
    const Triangle t = mesh->triangles[e.t0];
    const int apex = t[0] + t[1] + t[2] - e.a - e.b;
    int from = e.a;
    for (size_t k = 0; k <= inside.size(); ++k) {
      const int to = k < inside.size() ? inside[k].second : e.b;
      if (k == 0) {
        mesh->triangles[e.t0] = {from, to, apex};
      } else {
        mesh->triangles.push_back({from, to, apex});
      }
      from = to;
    }
    ++splits;
  }
  return splits;
}

double signedVolume(const Mesh& mesh, const std::vector<int>& triangles) {
  double six = 0;
  for (const int t : triangles) {
    const Triangle& v = mesh.triangles[t];
    six += mesh.vertices[v[0]].dot(mesh.vertices[v[1]].cross(mesh.vertices[v[2]]));
  }
  return six / 6;
}

/// A connected part of the mesh.
struct Part {
  std::vector<int> triangles;
  bool closed = true;
  Eigen::AlignedBox3d box;
};

void turn(Mesh* mesh, const std::vector<int>& triangles) {
  for (const int t : triangles) std::swap(mesh->triangles[t][1], mesh->triangles[t][2]);
}

/// Makes the corner order agree within each connected part, changing as few triangles as possible.
std::vector<Part> alignParts(Mesh* mesh, const Topology& topology, int* turned) {
  std::vector<Part> parts;
  std::vector<int> flip(mesh->triangles.size(), -1);
  for (size_t seed = 0; seed < mesh->triangles.size(); ++seed) {
    if (flip[seed] >= 0) continue;
    Part part;
    part.triangles.push_back(int(seed));
    flip[seed] = 0;

    for (size_t k = 0; k < part.triangles.size(); ++k) {
      const int t = part.triangles[k];
      for (int c = 0; c < 3; ++c) part.box.extend(mesh->vertices[mesh->triangles[t][c]]);
      for (int c = 0; c < 3; ++c) {
        const MeshEdge& e = topology.edges[topology.edges_of_triangle[t][c]];
        if (e.uses != 2) {
          part.closed = false;
          continue;
        }
        const int other = e.t0 == t ? e.t1 : e.t0;
        if (flip[other] >= 0) continue;
        // Both run the edge the same way: one of them is the wrong way round.
        const auto runs = [&](int triangle) {
          const Triangle& v = mesh->triangles[triangle];
          return (v[0] == e.a && v[1] == e.b) || (v[1] == e.a && v[2] == e.b) || (v[2] == e.a && v[0] == e.b);
        };
        flip[other] = flip[t] ^ int(runs(t) == runs(other));
        part.triangles.push_back(other);
      }
    }

    std::vector<int> odd, even;
    for (const int t : part.triangles) (flip[t] ? odd : even).push_back(t);
    const std::vector<int>& fewer = odd.size() <= even.size() ? odd : even;
    turn(mesh, fewer);
    *turned += int(fewer.size());
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Turns closed parts outward; a part inside another one may be a cavity and keeps its side.
void turnOutward(RepairedMesh* out, const std::vector<Part>& parts) {
  int inward = 0;
  for (size_t k = 0; k < parts.size(); ++k) {
    if (!parts[k].closed) continue;
    const bool nested = std::any_of(parts.begin(), parts.end(), [&](const Part& p) {
      return &p != &parts[k] && p.closed && p.box.contains(parts[k].box) &&
             p.box.volume() > parts[k].box.volume();
    });
    if (nested || signedVolume(out->mesh, parts[k].triangles) >= 0) continue;
    turn(&out->mesh, parts[k].triangles);
    ++inward;
  }
  out->inside_out = inward > 0;
}

}  // namespace

RepairedMesh repairMesh(const std::string& name, const Mesh& mesh, double weld_share) {
  RepairedMesh out;
  out.mesh = mesh;
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) {
      if (v < 0 || v >= int(mesh.vertices.size()))
        throw BadInput(name + ": a triangle names a vertex that is missing");
      if (!mesh.vertices[v].allFinite()) throw BadInput(name + ": a vertex is not finite; repair the mesh");
    }
  }

  Eigen::AlignedBox3d box;
  double magnitude = 0;
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) {
      box.extend(mesh.vertices[v]);
      magnitude = std::max(magnitude, mesh.vertices[v].cwiseAbs().maxCoeff());
    }
  }
  if (mesh.triangles.empty() || !(box.diagonal().norm() > 0)) {
    throw BadInput(name + ": the mesh has no triangle with an area; export the part's solid again");
  }

  // Files mostly hold single precision: far from the origin that is coarser than the share of the diameter.
  out.tolerance = std::max({weld_share * box.diagonal().norm(), 2.0 * FLT_EPSILON * magnitude, 1e-12});
  weld(&out.mesh, out.tolerance);
  out.degenerate = dropDegenerate(&out.mesh, out.tolerance);
  if (out.mesh.triangles.empty()) {
    throw BadInput(name + ": every triangle of the mesh is without area; export the part's solid again");
  }

  for (int round = 0; round < 4 && closeTJunctions(&out.mesh, out.tolerance) > 0; ++round) {
    dropDegenerate(&out.mesh, out.tolerance);
  }
  const std::vector<Part> parts = alignParts(&out.mesh, buildTopology(out.mesh), &out.turned);
  turnOutward(&out, parts);

  for (const MeshEdge& e : buildTopology(out.mesh).edges) {
    out.rim_edges += e.uses == 1;
    out.crowded_edges += e.uses > 2;
  }
  out.closed = out.rim_edges == 0;
  return out;
}

}  // namespace monocular_eye_hand
