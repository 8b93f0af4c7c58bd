#include "model/sharp_features.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace monocular_eye_hand {
namespace {

constexpr double kArcFitShare = 2e-3;  // vertices of an arc lie on it within this share of its radius
constexpr size_t kMinSegments = 3;

/// Mesh edges in order between the same two surfaces; edge k runs from vertex k to vertex k + 1.
struct Chain {
  std::vector<int> vertices;
  std::vector<int> edges;
  std::array<int, 2> surface{-1, -1};
  bool closed = false;
};

class SharpFeatureFinder {
 public:
  SharpFeatureFinder(const Mesh& mesh, const Topology& topology, const SurfaceSplit& split, double tolerance)
      : mesh_(mesh), topology_(topology), split_(split), tolerance_(tolerance) {}

  SharpFeatures find() {
    collectChains();
    for (const Chain& chain : chains_) splitChain(chain);
    linkCorners();
    return std::move(out_);
  }

 private:
  const Eigen::Vector3d& at(int v) const { return mesh_.vertices[v]; }
  const MeshEdge& meshEdge(int e) const { return topology_.edges[e]; }

  std::array<int, 2> pairOf(int edge) const {
    const MeshEdge& e = meshEdge(edge);
    const int s0 = split_.surface_of_triangle[e.t0], s1 = e.t1 >= 0 ? split_.surface_of_triangle[e.t1] : -1;
    return s1 < 0 ? std::array<int, 2>{s0, -1} : std::array<int, 2>{std::min(s0, s1), std::max(s0, s1)};
  }

  void collectChains() {
    std::vector<std::vector<int>> at_vertex(mesh_.vertices.size());
    std::vector<int> sharp;
    for (size_t k = 0; k < topology_.edges.size(); ++k) {
      if (!split_.sharp[k]) continue;
      sharp.push_back(int(k));
      at_vertex[meshEdge(int(k)).a].push_back(int(k));
      at_vertex[meshEdge(int(k)).b].push_back(int(k));
    }

    std::vector<char> used(topology_.edges.size(), 0);
    const auto passes = [&](int v) {
      return at_vertex[v].size() == 2 && pairOf(at_vertex[v][0]) == pairOf(at_vertex[v][1]) &&
             meshEdge(at_vertex[v][0]).convex == meshEdge(at_vertex[v][1]).convex;
    };

    const auto walk = [&](int edge, int from) {
      Chain chain;
      chain.surface = pairOf(edge);
      chain.vertices.push_back(from);
      int v = from;
      for (int e = edge; e >= 0;) {
        used[e] = 1;
        chain.edges.push_back(e);
        v = meshEdge(e).a == v ? meshEdge(e).b : meshEdge(e).a;
        chain.vertices.push_back(v);
        if (!passes(v) || v == from) break;
        const int next = at_vertex[v][0] == e ? at_vertex[v][1] : at_vertex[v][0];
        e = used[next] ? -1 : next;
      }
      chain.closed = chain.vertices.front() == chain.vertices.back() && chain.edges.size() > 2;
      chains_.push_back(std::move(chain));
    };

    for (const int e : sharp) {
      for (const int v : {meshEdge(e).a, meshEdge(e).b}) {
        if (!used[e] && !passes(v)) walk(e, v);
      }
    }
    for (const int e : sharp) {
      if (!used[e]) walk(e, meshEdge(e).a);
    }
  }

  /// Chain positions where the line really turns: vertices on a straight line are passed over.
  std::vector<int> turningPoints(const Chain& chain) const {
    const int n = int(chain.edges.size());
    std::vector<int> kept{0};
    for (int k = 1; k < n; ++k) {
      if (turns(at(chain.vertices[kept.back()]), at(chain.vertices[k]), at(chain.vertices[k + 1])))
        kept.push_back(k);
    }
    kept.push_back(n);
    if (chain.closed && kept.size() > 3 &&
        !turns(at(chain.vertices[kept[kept.size() - 2]]), at(chain.vertices[0]),
               at(chain.vertices[kept[1]]))) {
      kept.erase(kept.begin());  // the walk began inside a straight run
      kept.back() = n + kept.front();
    }
    return kept;
  }

  bool turns(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) const {
    const Eigen::Vector3d ac = c - a;
    const double length = ac.norm();
    if (length < tolerance_) return true;
    return (b - a).cross(ac).norm() / length > 4 * tolerance_ || (b - a).dot(c - b) < 0;
  }

  void splitChain(const Chain& chain) {
    std::vector<int> knots = turningPoints(chain);
    if (chain.closed) {
      if (addArc(chain, knots, 0, knots.size() - 1, true)) return;
      startAtLongest(chain, &knots);
    }

    for (size_t i = 0; i + 1 < knots.size();) {
      size_t end = i + 1;
      if (i + kMinSegments < knots.size() && isArc(chain, knots, i, i + kMinSegments, false)) {
        end = i + kMinSegments;
        while (end + 1 < knots.size() && isArc(chain, knots, i, end + 1, false)) ++end;
        if (!addArc(chain, knots, i, end, false)) {
          for (size_t k = i; k < end; ++k) addEdge(chain, knots[k], knots[k + 1]);
        }
      } else {
        addEdge(chain, knots[i], knots[i + 1]);
      }
      i = end;
    }
  }

  /// Turns the knots of a closed chain so that they begin with the longest straight piece.
  void startAtLongest(const Chain& chain, std::vector<int>* knots) const {
    const int n = int(chain.edges.size()), count = int(knots->size()) - 1;
    int longest = 0;
    double length = -1;
    for (int k = 0; k < count; ++k) {
      const double l = (position(chain, (*knots)[k + 1]) - position(chain, (*knots)[k])).norm();
      if (l > length * (1 + 1e-9)) {
        length = l;
        longest = k;
      }
    }
    std::vector<int> turned;
    for (int k = 0; k <= count; ++k) {
      const int at = longest + k;
      turned.push_back((*knots)[at % count] + (at >= count ? n : 0));
    }
    *knots = std::move(turned);
  }

  /// Position of a knot; knots of closed chains may run once past the end.
  const Eigen::Vector3d& position(const Chain& chain, int knot) const {
    const int n = int(chain.edges.size());
    return at(chain.vertices[knot > n ? knot - n : knot]);
  }

  CircleFit fitKnots(const Chain& chain, const std::vector<int>& knots, size_t begin, size_t end,
                     bool full) const {
    std::vector<Eigen::Vector3d> points;
    for (size_t k = begin; k <= (full ? end - 1 : end); ++k) points.push_back(position(chain, knots[k]));
    return fitCircle(points);
  }

  /// Tests the fit of one circle to the knots begin..end.
  bool isArc(const Chain& chain, const std::vector<int>& knots, size_t begin, size_t end, bool full) const {
    if (end - begin < kMinSegments) return false;
    const CircleFit c = fitKnots(chain, knots, begin, end, full);
    if (!c.valid || c.residual > kArcFitShare * c.radius + 4 * tolerance_) return false;
    double sweep = 0, widest = 0, narrowest = 1e300;
    for (size_t k = begin; k < end; ++k) {
      const double angle = turnAbout(c, position(chain, knots[k]), position(chain, knots[k + 1]));
      if (std::abs(angle) > kLargestSegment || angle * sweep < 0) return false;
      sweep += angle;
      widest = std::max(widest, std::abs(angle));
      // The first and last piece may be cut short by a neighbouring face.
      if (full || (k > begin && k + 1 < end)) narrowest = std::min(narrowest, std::abs(angle));
    }
    if (full && std::abs(std::abs(sweep) - 2 * M_PI) > 0.01) return false;
    // An arc is tessellated about evenly: a long piece among short ones is a straight line beside an arc.
    return widest < 4 * narrowest;
  }

  static double turnAbout(const CircleFit& c, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d u = a - c.centre, v = b - c.centre;
    return std::atan2(c.axis.dot(u.cross(v)), u.dot(v));
  }

  /// Left and right normals of a mesh edge walked along `chain` at position k, summed by length into `sum`.
  void addNormals(const Chain& chain, int k, std::array<Eigen::Vector3d, 2>* sum) const {
    const int n = int(chain.edges.size());
    const int index = k % n;
    const MeshEdge& e = meshEdge(chain.edges[index]);
    const double length = (at(e.b) - at(e.a)).norm();
    const bool forward = e.a == chain.vertices[index];
    (*sum)[forward ? 0 : 1] += length * topology_.normals[e.t0];
    if (e.t1 >= 0) (*sum)[forward ? 1 : 0] += length * topology_.normals[e.t1];
  }

  /// Surface on the left of the chain's walk.
  int leftSurface(const Chain& chain, int k, bool left) const {
    const int index = k % int(chain.edges.size());
    const MeshEdge& e = meshEdge(chain.edges[index]);
    const bool forward = e.a == chain.vertices[index];
    const int t = forward == left ? e.t0 : e.t1;
    return t < 0 ? -1 : split_.surface_of_triangle[t];
  }

  void addEdge(const Chain& chain, int from, int to) {
    ModelEdge edge;
    edge.p = position(chain, from);
    edge.q = position(chain, to);
    std::array<Eigen::Vector3d, 2> normal{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    for (int k = from; k < to; ++k) addNormals(chain, k, &normal);
    edge.surface = {leftSurface(chain, from, true), leftSurface(chain, from, false)};
    int p = chain.vertices[from > int(chain.edges.size()) ? from - int(chain.edges.size()) : from];
    int q = chain.vertices[to > int(chain.edges.size()) ? to - int(chain.edges.size()) : to];

    if (edge.surface[0] < 0) {
      std::swap(edge.p, edge.q);
      std::swap(p, q);
      std::swap(edge.surface[0], edge.surface[1]);
      std::swap(normal[0], normal[1]);
    }

    if (edge.surface[1] < 0) normal[1] = -normal[0];
    for (int s = 0; s < 2; ++s) edge.normal[s] = normal[s].normalized();
    edge.dihedral =
        std::atan2(edge.normal[0].cross(edge.normal[1]).norm(), edge.normal[0].dot(edge.normal[1]));
    edge.convex = meshEdge(chain.edges[from % int(chain.edges.size())]).convex;

    edge_ends_.push_back({p, q});
    out_.edges.push_back(edge);
  }

  bool addArc(const Chain& chain, const std::vector<int>& knots, size_t begin, size_t end, bool full) {
    if (!isArc(chain, knots, begin, end, full)) return false;
    const CircleFit c = fitKnots(chain, knots, begin, end, full);
    ModelCircle circle;
    circle.centre = c.centre;
    circle.radius = c.radius;
    circle.surface = chain.surface;
    circle.axis = axisOf(c.axis, chain.surface);

    double sweep = 0;
    for (size_t k = begin; k < end; ++k) {
      const double angle = turnAbout(c, position(chain, knots[k]), position(chain, knots[k + 1]));
      sweep += angle;
      circle.segment = std::max(circle.segment, std::abs(angle));
    }
    if (std::abs(sweep) < kSmallestSweep) return false;

    const bool counter_clockwise = sweep * c.axis.dot(circle.axis) > 0;
    const Eigen::Vector3d first = position(chain, knots[counter_clockwise ? begin : end]) - c.centre;
    circle.x_axis = (first - circle.axis * circle.axis.dot(first)).normalized();
    circle.sweep = full ? 2 * M_PI : std::abs(sweep);
    setNormals(chain, knots[begin], knots[end], &circle);
    // Both sides of the walk can be one surface (a cut in a free form): then surface[0] counts as its left.
    circle.left = (leftSurface(chain, knots[begin], true) == circle.surface[0]) == counter_clockwise;
    circle.convex = meshEdge(chain.edges[knots[begin] % int(chain.edges.size())]).convex;

    out_.circles.push_back(circle);
    return true;
  }

  Eigen::Vector3d axisOf(const Eigen::Vector3d& axis, const std::array<int, 2>& surfaces) const {
    for (const int s : surfaces) {
      if (s < 0 || split_.surfaces[s].kind != Surface::Kind::kPlane) continue;
      const double along = split_.surfaces[s].axis.dot(axis);
      if (std::abs(along) > 0.9) return along > 0 ? axis : Eigen::Vector3d(-axis);
    }
    Eigen::Index largest;
    axis.cwiseAbs().maxCoeff(&largest);
    return axis[largest] < 0 ? Eigen::Vector3d(-axis) : axis;
  }

  /// Mean normals of the two surfaces, seen in the rotating (radius, axis) frame.
  void setNormals(const Chain& chain, int from, int to, ModelCircle* circle) const {
    std::array<Eigen::Vector2d, 2> sum{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
    for (int k = from; k < to; ++k) {
      const MeshEdge& e = meshEdge(chain.edges[k % int(chain.edges.size())]);
      const Eigen::Vector3d middle = 0.5 * (at(e.a) + at(e.b)) - circle->centre;
      const Eigen::Vector3d radial = (middle - circle->axis * circle->axis.dot(middle)).normalized();
      const double length = (at(e.b) - at(e.a)).norm();
      const int s0 = split_.surface_of_triangle[e.t0] == circle->surface[0] ? 0 : 1;

      const auto add = [&](int slot, int t) {
        const Eigen::Vector3d& n = topology_.normals[t];
        sum[slot] += length * Eigen::Vector2d(n.dot(radial), n.dot(circle->axis));
      };
      add(s0, e.t0);
      if (e.t1 >= 0) add(1 - s0, e.t1);
    }

    if (circle->surface[1] < 0) sum[1] = -sum[0];
    for (int s = 0; s < 2; ++s) circle->normal[s] = sum[s].normalized();
    const Eigen::Vector2d &a = circle->normal[0], &b = circle->normal[1];
    circle->dihedral = std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
  }

  void linkCorners() {
    std::map<int, std::vector<int>> ends;
    for (size_t e = 0; e < edge_ends_.size(); ++e) {
      for (const int v : edge_ends_[e]) ends[v].push_back(int(e));
    }
    for (auto& [v, edges] : ends) {
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      if (edges.size() < 2) continue;
      for (const int e : edges) {
        for (int s = 0; s < 2; ++s) {
          if (edge_ends_[e][s] == v) out_.edges[e].vertex[s] = int(out_.corners.size());
        }
      }
      out_.corners.push_back({at(v), edges});
    }
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const SurfaceSplit& split_;
  double tolerance_;
  std::vector<Chain> chains_;
  std::vector<std::array<int, 2>> edge_ends_;
  SharpFeatures out_;
};

}  // namespace

SharpFeatures findSharpFeatures(const Mesh& mesh, const Topology& topology, const SurfaceSplit& split,
                                double tolerance) {
  return SharpFeatureFinder(mesh, topology, split, tolerance).find();
}

}  // namespace monocular_eye_hand
