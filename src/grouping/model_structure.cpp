#include "grouping/model_structure.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace monocular_eye_hand {
namespace {

constexpr double kSamePoint = 1e-4;     // of the diameter
constexpr double kSmallestBend = 0.17;  // [rad] flatter meetings look like one line
constexpr double kFlat = 0.02;          // sine up to which directions count as in one plane or parallel
constexpr double kCoaxial = 0.01;       // of the diameter: largest distance between the axes of a circle pair
constexpr double kMinOverlap = 0.3;     // of the shorter edge, of parallel edges
// Largest number of structural groupings of one kind: bounds the work on CAD files with thousands of edges.
constexpr size_t kMaxPerKind = 20000;

using Groupings = std::vector<ModelGrouping>;

Groupings edges(const EdgeGraph& g) {
  Groupings result;
  for (int e = 0; e < int(g.model.edges.size()); ++e) {
    ModelGrouping m;
    m.kind = GroupingKind::kEdge;
    m.edges = {e};
    m.points = {g.at(2 * e), g.at(2 * e + 1)};
    result.push_back(m);
  }
  return result;
}

Groupings junctions(const EdgeGraph& g) {
  Groupings result;
  for (size_t p = 0; p < g.points.size() && result.size() < kMaxPerKind; ++p)
    for (int a : g.ends_at[p])
      for (int b : g.ends_at[p]) {
        if (b <= a || !g.bends(a, b)) continue;
        ModelGrouping m;
        m.kind = GroupingKind::kJunction;
        m.edges = {a / 2, b / 2};
        m.points = {g.at(a ^ 1), g.points[p], g.at(b ^ 1)};
        result.push_back(m);
      }
  return result;
}

/// Angular order of three directions in an image taken from the side `outside` points to.
std::array<int, 3> turningOrder(const EdgeGraph& g, std::array<int, 3> ends, const Eigen::Vector3d& outside) {
  const Eigen::Vector3d z = -outside.normalized();  // optical frame: x right, y down, z forward
  const Eigen::Vector3d x = z.unitOrthogonal(), y = z.cross(x);
  const auto angle = [&](int end) { return std::atan2(g.away(end).dot(y), g.away(end).dot(x)); };
  std::sort(ends.begin(), ends.end(), [&](int a, int b) { return angle(a) < angle(b); });
  return ends;
}

/// A corner of exactly three planes whose edges are all convex, or all concave, turns the same way in every
/// image that shows its three edges: two of its edges can change places only where their common face is seen
/// edge-on, and beyond that one of the three edges is hidden.
bool turnsOneWay(const EdgeGraph& g, const std::array<int, 3>& ends, size_t meeting,
                 Eigen::Vector3d* outside) {
  if (meeting != 3) return false;
  std::vector<int> planes;
  *outside = Eigen::Vector3d::Zero();
  for (int end : ends) {
    const ModelEdge& edge = g.model.edges[end / 2];
    if (edge.convex != g.model.edges[ends[0] / 2].convex) return false;
    for (int k = 0; k < 2; ++k) {
      if (edge.surface[k] < 0 || g.model.surfaces[edge.surface[k]].kind != Surface::Kind::kPlane)
        return false;
      planes.push_back(edge.surface[k]);
      *outside += edge.normal[k];
    }
  }
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  return planes.size() == 3 && outside->norm() > 1e-3;
}

Groupings triplets(const EdgeGraph& g) {
  Groupings result;
  for (size_t p = 0; p < g.points.size(); ++p) {
    const std::vector<int>& at = g.ends_at[p];
    for (size_t i = 0; i < at.size(); ++i)
      for (size_t j = i + 1; j < at.size(); ++j)
        for (size_t k = j + 1; k < at.size() && result.size() < kMaxPerKind; ++k) {
          std::array<int, 3> ends{at[i], at[j], at[k]};
          // Three directions in one plane fix no pose as a corner; two in line look like an edge with a stem.
          if (!g.bends(ends[0], ends[1]) || !g.bends(ends[1], ends[2]) || !g.bends(ends[0], ends[2]))
            continue;

          ModelGrouping m;
          m.kind = GroupingKind::kTriplet;
          Eigen::Vector3d outside;
          m.oriented = turnsOneWay(g, ends, at.size(), &outside);
          if (m.oriented) ends = turningOrder(g, ends, outside);
          m.points = {g.points[p]};
          for (int end : ends) {
            m.edges.push_back(end / 2);
            m.points.push_back(g.at(end ^ 1));
          }
          result.push_back(m);
        }
  }
  return result;
}

/// kU or kZ for a chain in one plane, which every image preserves; kNone for one in space.
GroupingShape chainShape(const std::vector<Eigen::Vector3d>& p) {
  const Eigen::Vector3d shared = (p[2] - p[1]).normalized();
  const Eigen::Vector3d a = shared.cross(p[0] - p[1]).normalized(),
                        b = shared.cross(p[3] - p[2]).normalized();
  if (a.cross(b).norm() > kFlat) return GroupingShape::kNone;
  return a.dot(b) > 0 ? GroupingShape::kU : GroupingShape::kZ;
}

Groupings chains(const EdgeGraph& g) {
  Groupings result;
  for (int e = 0; e < int(g.model.edges.size()) && result.size() < kMaxPerKind; ++e)
    for (int a : g.ends_at[g.point_of_end[2 * e]])
      for (int b : g.ends_at[g.point_of_end[2 * e + 1]]) {
        if (a / 2 == e || b / 2 == e || a / 2 == b / 2) continue;
        if (!g.bends(a, 2 * e) || !g.bends(b, 2 * e + 1)) continue;
        ModelGrouping m;
        m.kind = GroupingKind::kChain;
        m.edges = {a / 2, e, b / 2};
        m.points = {g.at(a ^ 1), g.at(2 * e), g.at(2 * e + 1), g.at(b ^ 1)};
        m.shape = chainShape(m.points);
        result.push_back(m);
      }
  return result;
}

/// Is a closed ring flat and convex? `normal`: its plane's, in either sense.
bool convexRing(const std::vector<Eigen::Vector3d>& p, Eigen::Vector3d* normal) {
  *normal = (p[2] - p[0]).cross(p[3] - p[1]);
  if (normal->norm() < 1e-12) return false;
  normal->normalize();
  const double size = std::max((p[2] - p[0]).norm(), (p[3] - p[1]).norm());
  for (int i = 0; i < 4; ++i) {
    if (std::abs(normal->dot(p[i] - p[0])) > kFlat * size) return false;
    const Eigen::Vector3d in = p[i] - p[(i + 3) % 4], out = p[(i + 1) % 4] - p[i];
    if (normal->dot(in.normalized().cross(out.normalized())) < std::sin(kSmallestBend)) return false;
  }
  return true;
}

/// The planar surface that all four edges bound, or -1.
int commonPlane(const ObjectModel& model, const std::vector<int>& edges) {
  for (int surface : model.edges[edges[0]].surface) {
    if (surface < 0 || model.surfaces[surface].kind != Surface::Kind::kPlane) continue;
    const bool all = std::all_of(edges.begin(), edges.end(), [&](int e) {
      return model.edges[e].surface[0] == surface || model.edges[e].surface[1] == surface;
    });
    if (all) return surface;
  }
  return -1;
}

/// A face with outward normal n shows its four edges only from its outer side when the neighbours m1, m2 of
/// two opposite edges add up to a non-negative multiple of n: no eye behind n is in front of both.
bool seenFromOneSide(const ObjectModel& model, const std::vector<int>& edges, int surface) {
  const Eigen::Vector3d n = model.surfaces[surface].axis;
  std::array<Eigen::Vector3d, 4> neighbour;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int e : edges) centre += 0.125 * (model.edges[e].p + model.edges[e].q);
  for (int i = 0; i < 4; ++i) {
    const ModelEdge& edge = model.edges[edges[i]];
    if (!edge.convex || edge.surface[0] < 0 || edge.surface[1] < 0) return false;
    neighbour[i] = edge.normal[edge.surface[0] == surface ? 1 : 0];
    if (neighbour[i].dot(edge.p - centre) <= 0) return false;
  }
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector3d sum = neighbour[i] + neighbour[i + 2];
    if (sum.dot(n) > -1e-3 && (sum - sum.dot(n) * n).norm() < 1e-3) return true;
  }
  return false;
}

void addQuad(const EdgeGraph& g, const std::array<int, 4>& leaving, Groupings* out) {
  ModelGrouping m;
  m.kind = GroupingKind::kQuad;
  m.shape = GroupingShape::kClosed;
  for (int end : leaving) {
    m.edges.push_back(end / 2);
    m.points.push_back(g.at(end));
  }
  Eigen::Vector3d normal;
  if (!convexRing(m.points, &normal)) return;

  const int surface = commonPlane(g.model, m.edges);
  if (surface >= 0 && seenFromOneSide(g.model, m.edges, surface)) {
    m.oriented = true;
    // convexRing's normal looks to the side from which the ring turns counter-clockwise, which in an image
    // with v down is the sense of falling angles.
    if (normal.dot(g.model.surfaces[surface].axis) > 0) {
      std::reverse(m.points.begin() + 1, m.points.end());
      std::reverse(m.edges.begin(), m.edges.end());
    }
  }
  out->push_back(m);
}

Groupings quads(const EdgeGraph& g) {
  Groupings result;
  for (int e = 0; e < int(g.model.edges.size()) && result.size() < kMaxPerKind; ++e) {
    const int start = g.point_of_end[2 * e];
    for (int b : g.ends_at[g.point_of_end[2 * e + 1]]) {
      if (b / 2 <= e) continue;
      for (int c : g.ends_at[g.point_of_end[b ^ 1]]) {
        if (c / 2 <= e || c / 2 == b / 2) continue;
        for (int d : g.ends_at[g.point_of_end[c ^ 1]])
          if (d / 2 > e && d / 2 != b / 2 && d / 2 != c / 2 && g.point_of_end[d ^ 1] == start)
            addQuad(g, {2 * e, b, c, d}, &result);
      }
    }
  }
  return result;
}

bool sideBySide(const EdgeGraph& g, int a, int b, bool* same_sense) {
  const Eigen::Vector3d da = g.away(2 * a), db = g.away(2 * b);
  if (da.cross(db).norm() > kFlat) return false;
  *same_sense = da.dot(db) > 0;
  const Eigen::Vector3d between = g.at(2 * b) - g.at(2 * a);
  if (between.cross(da).norm() < kFlat * g.model.diameter) return false;  // one line
  const auto along = [&](int end) { return da.dot(g.at(end) - g.at(2 * a)); };
  const double length_a = along(2 * a + 1), b0 = along(2 * b), b1 = along(2 * b + 1);
  const double overlap = std::min(length_a, std::max(b0, b1)) - std::max(0.0, std::min(b0, b1));
  return overlap > kMinOverlap * std::min(length_a, std::abs(b1 - b0));
}

Groupings parallelPairs(const EdgeGraph& g) {
  Groupings result;
  const int count = int(g.model.edges.size());
  for (int a = 0; a < count && result.size() < kMaxPerKind; ++a)
    for (int b = a + 1; b < count; ++b) {
      bool same = true;
      if (!sideBySide(g, a, b, &same)) continue;
      ModelGrouping m;
      m.kind = GroupingKind::kParallelPair;
      m.edges = {a, b};
      m.points = {g.at(2 * a), g.at(2 * a + 1), g.at(2 * b + !same), g.at(2 * b + same)};
      result.push_back(m);
    }
  return result;
}

bool coaxial(const ObjectModel& model, const ModelCircle& a, const ModelCircle& b) {
  const Eigen::Vector3d between = b.centre - a.centre;
  return a.axis.cross(b.axis).norm() < kFlat && between.cross(a.axis).norm() < kCoaxial * model.diameter;
}

Groupings circleGroupings(const EdgeGraph& g) {
  Groupings single, pair, line;
  const int circles = int(g.model.circles.size());
  for (int a = 0; a < circles; ++a) {
    ModelGrouping m;
    m.kind = GroupingKind::kEllipse;
    m.circles = {a};
    single.push_back(m);

    m.kind = GroupingKind::kEllipsePair;
    for (int b = a + 1; b < circles && pair.size() < kMaxPerKind; ++b) {
      if (!coaxial(g.model, g.model.circles[a], g.model.circles[b])) continue;
      m.circles = {a, b};
      pair.push_back(m);
    }

    m.kind = GroupingKind::kEllipseLine;
    m.circles = {a};
    for (int e = 0; e < int(g.model.edges.size()) && line.size() < kMaxPerKind; ++e) {
      m.edges = {e};
      m.points = {g.at(2 * e), g.at(2 * e + 1)};
      line.push_back(m);
    }
  }

  single.insert(single.end(), pair.begin(), pair.end());
  single.insert(single.end(), line.begin(), line.end());
  return single;
}

}  // namespace

EdgeGraph::EdgeGraph(const ObjectModel& m) : model(m) {
  const int count = 2 * int(model.edges.size());
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return at(a).x() < at(b).x(); });
  point_of_end.assign(count, -1);
  const double tolerance = kSamePoint * model.diameter;
  for (int i = 0; i < count; ++i) {
    if (point_of_end[order[i]] >= 0) continue;
    const Eigen::Vector3d p = at(order[i]);
    for (int j = i; j < count && at(order[j]).x() <= p.x() + tolerance; ++j)
      if (point_of_end[order[j]] < 0 && (at(order[j]) - p).norm() <= tolerance)
        point_of_end[order[j]] = int(points.size());
    points.push_back(p);
  }
  ends_at.resize(points.size());
  for (int end = 0; end < count; ++end) ends_at[point_of_end[end]].push_back(end);
}

bool EdgeGraph::bends(int end_a, int end_b) const {
  return away(end_a).cross(away(end_b)).norm() > std::sin(kSmallestBend);
}

std::vector<ModelGrouping> structuralGroupings(const EdgeGraph& graph) {
  Groupings all;
  for (const auto& part : {edges(graph), junctions(graph), triplets(graph), chains(graph), quads(graph),
                           parallelPairs(graph), circleGroupings(graph)})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

Abilities abilitiesOf(const ObjectModel& model) {
  const EdgeGraph graph(model);
  Abilities a;
  const auto can = [&](GroupingKind kind) -> bool& { return a.kind[int(kind)]; };
  can(GroupingKind::kEdge) = !model.edges.empty();
  can(GroupingKind::kEllipse) = !model.circles.empty();
  can(GroupingKind::kEllipseLine) = !model.edges.empty() && !model.circles.empty();
  can(GroupingKind::kJunction) = !junctions(graph).empty();
  can(GroupingKind::kTriplet) = !triplets(graph).empty();
  can(GroupingKind::kQuad) = !quads(graph).empty();
  can(GroupingKind::kParallelPair) = !parallelPairs(graph).empty();

  for (const ModelGrouping& chain : chains(graph)) {
    can(GroupingKind::kChain) = true;
    a.u_chain |= chain.shape != GroupingShape::kZ;
    a.z_chain |= chain.shape != GroupingShape::kU;
  }

  for (size_t i = 0; i < model.circles.size(); ++i)
    for (size_t j = i + 1; j < model.circles.size() && !can(GroupingKind::kEllipsePair); ++j)
      can(GroupingKind::kEllipsePair) = coaxial(model, model.circles[i], model.circles[j]);
  return a;
}

}  // namespace monocular_eye_hand
