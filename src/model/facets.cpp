#include "model/facets.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace monocular_eye_hand {
namespace {

constexpr double kFlat = 0.005;   // normals closer than this are one plane's [rad]
constexpr double kCoarse = 0.54;  // a little over 2 pi / 12: the coarsest wall taken for round [rad]
constexpr double kEqual = 0.1;    // facets of a coarse wall agree in width and angle to this share
constexpr double kPlaneWidth =
    2.5;  // a plane beside a curved surface is wider than its facets by this factor

/// Height of the vertex of `triangle` opposite the edge over the plane of `over`.
double rise(const Mesh& mesh, const Topology& topology, const MeshEdge& e, int triangle, int over) {
  const auto& t = mesh.triangles[triangle];
  const int apex = t[0] + t[1] + t[2] - e.a - e.b;
  return std::abs(topology.normals[over].dot(mesh.vertices[apex] - mesh.vertices[e.a]));
}

bool coplanar(const Mesh& mesh, const Topology& topology, const MeshEdge& e, double tolerance) {
  if (e.uses != 2) return false;
  if (e.angle < kFlat) return true;
  // Slivers have noisy normals: their corners decide.
  return e.angle < 0.5 && rise(mesh, topology, e, e.t0, e.t1) < 2 * tolerance &&
         rise(mesh, topology, e, e.t1, e.t0) < 2 * tolerance;
}

void growFacets(const Mesh& mesh, const Topology& topology, double tolerance, Facets* out) {
  out->facet_of_triangle.assign(mesh.triangles.size(), -1);
  std::vector<int> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return topology.areas[a] > topology.areas[b]; });

  for (const int seed : order) {
    if (out->facet_of_triangle[seed] >= 0) continue;
    const int id = int(out->facets.size());
    Facet facet;
    const Eigen::Vector3d n = topology.normals[seed], origin = mesh.vertices[mesh.triangles[seed][0]];
    // Fine tessellation of a wide curve must not creep into one "plane".
    const double reach = std::max(4 * tolerance, 2 * kFlat * std::sqrt(topology.areas[seed]));
    facet.triangles.push_back(seed);
    out->facet_of_triangle[seed] = id;

    for (size_t k = 0; k < facet.triangles.size(); ++k) {
      const int t = facet.triangles[k];
      for (const int edge : topology.edges_of_triangle[t]) {
        const MeshEdge& e = topology.edges[edge];
        if (!coplanar(mesh, topology, e, tolerance)) continue;
        const int other = e.t0 == t ? e.t1 : e.t0;
        if (out->facet_of_triangle[other] >= 0) continue;
        const auto& v = mesh.triangles[other];
        const bool near = std::all_of(
            v.begin(), v.end(), [&](int i) { return std::abs(n.dot(mesh.vertices[i] - origin)) < reach; });
        const bool parallel = topology.normals[other].dot(n) > std::cos(2 * kFlat) ||
                              topology.areas[other] < 1e-3 * topology.areas[seed];
        if (!near || !parallel) continue;
        out->facet_of_triangle[other] = id;
        facet.triangles.push_back(other);
      }
    }

    for (const int t : facet.triangles) {
      facet.area += topology.areas[t];
      facet.normal += topology.areas[t] * topology.normals[t];
      facet.vertices.insert(facet.vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
    }
    facet.normal.normalize();
    std::sort(facet.vertices.begin(), facet.vertices.end());
    facet.vertices.erase(std::unique(facet.vertices.begin(), facet.vertices.end()), facet.vertices.end());
    out->facets.push_back(std::move(facet));
  }
}

double width(const Mesh& mesh, const Facet& facet, const MeshEdge& e) {
  const Eigen::Vector3d along = (mesh.vertices[e.b] - mesh.vertices[e.a]).normalized();
  const Eigen::Vector3d across = facet.normal.cross(along);
  double low = 1e300, high = -1e300;
  for (const int v : facet.vertices) {
    const double s = across.dot(mesh.vertices[v]);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  return high - low;
}

bool similar(double a, double b) { return std::abs(a - b) <= kEqual * std::max(a, b); }

/// Keeps the links above the sharp angle only where a third facet continues the row with equal width and
/// angle.
void judgeCoarseLinks(const Topology& topology, double sharp_angle, Facets* out) {
  const auto continues = [&](int facet, const FacetLink& link) {
    const MeshEdge& e = topology.edges[link.edge];
    const auto& links = out->facets[facet].links;
    return std::any_of(links.begin(), links.end(), [&](const FacetLink& next) {
      return next.facet != link.facet && topology.edges[next.edge].convex == e.convex &&
             similar(next.angle, link.angle) && similar(next.width, link.width) &&
             similar(next.other_width, link.width);
    });
  };

  for (size_t f = 0; f < out->facets.size(); ++f) {
    for (const FacetLink& link : out->facets[f].links) {
      if (link.angle < sharp_angle || int(f) > link.facet) continue;
      const bool equal = similar(link.width, link.other_width);
      FacetLink back = link;
      back.facet = int(f);
      std::swap(back.width, back.other_width);
      out->smooth[link.edge] = equal && (continues(int(f), link) || continues(link.facet, back));
    }
  }

  for (Facet& facet : out->facets) {
    facet.links.erase(std::remove_if(facet.links.begin(), facet.links.end(),
                                     [&](const FacetLink& l) { return !out->smooth[l.edge]; }),
                      facet.links.end());
  }
}

}  // namespace

Facets findFacets(const Mesh& mesh, const Topology& topology, double sharp_angle, double tolerance) {
  Facets out;
  growFacets(mesh, topology, tolerance, &out);

  out.smooth.assign(topology.edges.size(), 0);
  for (size_t k = 0; k < topology.edges.size(); ++k) {
    const MeshEdge& e = topology.edges[k];
    if (e.uses != 2 || e.angle > std::max(sharp_angle, kCoarse)) continue;
    const int f0 = out.facet_of_triangle[e.t0], f1 = out.facet_of_triangle[e.t1];
    if (f0 == f1) continue;
    const double w0 = width(mesh, out.facets[f0], e), w1 = width(mesh, out.facets[f1], e);
    out.smooth[k] = e.angle < sharp_angle;
    out.facets[f0].links.push_back({f1, int(k), e.angle, w0, w1});
    out.facets[f1].links.push_back({f0, int(k), e.angle, w1, w0});
  }

  judgeCoarseLinks(topology, sharp_angle, &out);
  for (Facet& facet : out.facets) {
    facet.plane = std::all_of(facet.links.begin(), facet.links.end(),
                              [](const FacetLink& l) { return l.width > kPlaneWidth * l.other_width; });
  }
  return out;
}

}  // namespace monocular_eye_hand
