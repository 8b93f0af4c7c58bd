#include "model/surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/facets.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSquareToAxis = 0.02;  // facets of a cylinder stand square to its axis within this [rad]
constexpr double kCylinderFitShare =
    2e-3;  // vertices of a cylinder lie on it within this share of the radius
constexpr size_t kMinFacets = 3;
constexpr double kFlattest = 1e-4;

class Splitter {
 public:
  Splitter(const Mesh& mesh, const Topology& topology, const Facets& facets, double tolerance)
      : mesh_(mesh), topology_(topology), facets_(facets), tolerance_(tolerance) {
    surface_of_facet_.assign(facets.facets.size(), -1);
    spent_.assign(facets.facets.size(), 0);
  }

  SurfaceSplit split() {
    for (size_t f = 0; f < facets_.facets.size(); ++f) {
      if (facets_.facets[f].plane) addSurface(Surface::Kind::kPlane, {int(f)});
    }
    growCylinders();
    growFreeforms();
    out_.surface_of_triangle.assign(mesh_.triangles.size(), -1);
    for (size_t s = 0; s < out_.surfaces.size(); ++s) {
      for (const int t : out_.surfaces[s].triangles) out_.surface_of_triangle[t] = int(s);
    }
    markSharp();
    return std::move(out_);
  }

 private:
  const Facet& facet(int f) const { return facets_.facets[f]; }
  bool isFree(int f) const { return surface_of_facet_[f] < 0; }

  void growCylinders() {
    std::vector<int> order(facets_.facets.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return facet(a).area > facet(b).area; });
    for (const int seed : order) {
      if (!isFree(seed)) continue;
      for (const FacetLink& link : facet(seed).links) {
        if (spent_[seed]) break;
        if (isFree(link.facet) && growCylinder(seed, link.facet)) break;
      }
    }
  }

  /// Facets connected with the seed through free facets that pass `accept`.
  template <class Accept>
  std::vector<int> connected(int seed, Accept accept) const {
    std::vector<int> found{seed};
    std::vector<char>& seen = seen_;
    seen.resize(facets_.facets.size(), 0);
    seen[seed] = 1;
    std::vector<int> touched{seed};
    for (size_t k = 0; k < found.size(); ++k) {
      for (const FacetLink& link : facet(found[k]).links) {
        if (seen[link.facet] || !isFree(link.facet)) continue;
        seen[link.facet] = 1;
        touched.push_back(link.facet);
        if (accept(link.facet)) found.push_back(link.facet);
      }
    }
    for (const int f : touched) seen[f] = 0;
    return found;
  }

  CylinderFit fit(const std::vector<int>& facets) const {
    std::vector<Eigen::Vector3d> points, normals;
    std::vector<double> weights;
    for (const int f : facets) {
      for (const int v : facet(f).vertices) points.push_back(mesh_.vertices[v]);
      normals.push_back(facet(f).normal);
      weights.push_back(facet(f).area);
    }
    return fitCylinder(points, normals, weights);
  }

  bool onCylinder(int f, const CylinderFit& c, double tolerance) const {
    if (std::abs(facet(f).normal.dot(c.axis)) > kSquareToAxis) return false;
    return std::all_of(facet(f).vertices.begin(), facet(f).vertices.end(), [&](int v) {
      const Eigen::Vector3d d = mesh_.vertices[v] - c.point;
      return std::abs((d - c.axis * c.axis.dot(d)).norm() - c.radius) < tolerance;
    });
  }

  bool growCylinder(int seed, int neighbour) {
    CylinderFit c = fit({seed, neighbour});
    std::vector<int> members;

    // First loosely around two facets, then with what a fit to all of them keeps.
    for (int round = 0; round < 4; ++round) {
      // So flat that the noise of the vertices would set the radius.
      if (!c.valid || c.radius * kFlattest > tolerance_ / kCylinderFitShare) return false;
      const double tolerance = (round == 0 ? 0.02 : kCylinderFitShare) * c.radius + 4 * tolerance_;
      if (!onCylinder(seed, c, tolerance)) return false;
      std::vector<int> now = connected(seed, [&](int f) { return onCylinder(f, c, tolerance); });
      if (now.size() < kMinFacets) return false;
      const bool same = round > 1 && now == members;
      members = std::move(now);
      if (same) break;
      c = fit(members);
    }

    if (!c.valid || c.residual > kCylinderFitShare * c.radius + 4 * tolerance_ || !hasCleanEnds(members, c)) {
      for (const int f : members) spent_[f] = 1;
      return false;
    }
    addCylinder(members, c);
    return true;
  }

  /// A strip of a sphere or torus also passes for a short cylinder. Where the wall runs on smoothly into
  /// other curved facets it must be divided along and across its axis, and be longer than a few facets: than
  /// those that it runs on into at its ends, as a wall into its rounded rim; where it runs on at its sides,
  /// than its own facets are wide and than a strip of a sphere can be within the tolerance of the fit (0.13
  /// radius).
  bool hasCleanEnds(const std::vector<int>& members, const CylinderFit& c) const {
    std::vector<int> sorted = members;
    std::sort(sorted.begin(), sorted.end());
    bool runs_on = false, aligned = true;
    double widest = 0, beyond = 0, low = 1e300, high = -1e300;

    for (const int f : members) {
      for (const FacetLink& link : facet(f).links) {
        const MeshEdge& e = topology_.edges[link.edge];
        const double along = std::abs(c.axis.dot((mesh_.vertices[e.b] - mesh_.vertices[e.a]).normalized()));
        if (!std::binary_search(sorted.begin(), sorted.end(), link.facet)) {
          runs_on = runs_on || isFree(link.facet);
          if (along < 0.5 && !facet(link.facet).plane) beyond = std::max(beyond, link.other_width);
          continue;
        }
        widest = std::max(widest, link.width);
        aligned = aligned && (along > 0.995 || along < 0.1);
      }

      for (const int v : facet(f).vertices) {
        low = std::min(low, c.axis.dot(mesh_.vertices[v]));
        high = std::max(high, c.axis.dot(mesh_.vertices[v]));
      }
    }

    if (beyond > 0) return aligned && high - low > 3 * beyond;
    return !runs_on || (aligned && high - low > std::max(3 * widest, 0.15 * c.radius));
  }

  void addCylinder(const std::vector<int>& members, CylinderFit c) {
    // A repeatable sign of the axis: its largest component is positive.
    Eigen::Index largest;
    c.axis.cwiseAbs().maxCoeff(&largest);
    if (c.axis[largest] < 0) c.axis = -c.axis;

    Surface& s = addSurface(Surface::Kind::kCylinder, members);
    s.point = c.point;
    s.axis = c.axis;
    s.radius = c.radius;

    double outward = 0, low = 1e300, high = -1e300, chord = 0;
    for (const int f : members) {
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (const int v : facet(f).vertices) {
        middle += mesh_.vertices[v] / double(facet(f).vertices.size());
        const double h = c.axis.dot(mesh_.vertices[v] - c.point);
        low = std::min(low, h);
        high = std::max(high, h);
      }
      const Eigen::Vector3d d = middle - c.point;
      const double axial = c.axis.dot(d);
      outward += facet(f).area * facet(f).normal.dot(d - c.axis * axial);
      for (const FacetLink& l : facet(f).links) chord = std::max(chord, std::min(l.width, l.other_width));
    }

    s.convex = outward > 0;
    s.point += c.axis * (0.5 * (low + high));
    s.half_length = 0.5 * (high - low);
    const double half_angle = std::asin(std::min(1.0, chord / (2 * c.radius)));
    out_.tessellation_error = std::max(out_.tessellation_error, c.radius * (1 - std::cos(half_angle)));
  }

  void growFreeforms() {
    for (size_t f = 0; f < facets_.facets.size(); ++f) {
      if (!isFree(int(f))) continue;
      const std::vector<int> members = connected(int(f), [](int) { return true; });
      addSurface(members.size() == 1 ? Surface::Kind::kPlane : Surface::Kind::kFreeform, members);
      for (const int m : members) {
        for (const FacetLink& l : facet(m).links) {
          // A chord w that turns by the angle a has the sagitta w a / 8.
          const double sagitta = std::min(l.width, l.other_width) * l.angle / 8;
          out_.tessellation_error = std::max(out_.tessellation_error, sagitta);
        }
      }
    }
  }

  Surface& addSurface(Surface::Kind kind, const std::vector<int>& members) {
    Surface s;
    s.kind = kind;
    s.point = s.axis = Eigen::Vector3d::Zero();
    for (const int f : members) {
      surface_of_facet_[f] = int(out_.surfaces.size());
      s.triangles.insert(s.triangles.end(), facet(f).triangles.begin(), facet(f).triangles.end());
      s.area += facet(f).area;
      s.axis += facet(f).area * facet(f).normal;
    }
    std::sort(s.triangles.begin(), s.triangles.end());
    for (const int t : s.triangles) {
      for (const int v : mesh_.triangles[t]) s.point += topology_.areas[t] / (3 * s.area) * mesh_.vertices[v];
    }
    s.axis = s.axis.norm() > 1e-9 * s.area ? s.axis.normalized() : Eigen::Vector3d::UnitZ();
    out_.surfaces.push_back(std::move(s));
    return out_.surfaces.back();
  }

  void markSharp() {
    out_.sharp.assign(topology_.edges.size(), 0);
    for (size_t k = 0; k < topology_.edges.size(); ++k) {
      const MeshEdge& e = topology_.edges[k];
      const bool inside_facet =
          e.uses == 2 && facets_.facet_of_triangle[e.t0] == facets_.facet_of_triangle[e.t1];
      out_.sharp[k] = !inside_facet && !facets_.smooth[k];
    }
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const Facets& facets_;
  double tolerance_;
  std::vector<int> surface_of_facet_;
  std::vector<char> spent_;  // lay in a strip that was no cylinder: no seed for another
  mutable std::vector<char> seen_;
  SurfaceSplit out_;
};

}  // namespace

SurfaceSplit splitSurfaces(const Mesh& mesh, const Topology& topology, double sharp_angle, double tolerance) {
  const Facets facets = findFacets(mesh, topology, sharp_angle, tolerance);
  return Splitter(mesh, topology, facets, tolerance).split();
}

std::vector<SmoothBorder> smoothBorders(const Topology& topology, const SurfaceSplit& split) {
  std::vector<SmoothBorder> borders;
  for (size_t k = 0; k < topology.edges.size(); ++k) {
    const MeshEdge& edge = topology.edges[k];
    if (split.sharp[k] || edge.t1 < 0) continue;
    const int a = split.surface_of_triangle[size_t(edge.t0)], b = split.surface_of_triangle[size_t(edge.t1)];
    if (a != b) borders.push_back({a, b, &edge});
  }
  return borders;
}

}  // namespace monocular_eye_hand
