#include "grouping/model_symmetry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace monocular_eye_hand {
namespace {

// A feature's copy lies within this share of the diameter of the feature it falls on.
constexpr double kCopyTolerance = 0.01;

/// The nearest of `count` features; -1 when it is farther than `tolerance`.
template <class Distance>
int nearest(int count, double tolerance, const Distance& distance) {
  int best = -1;
  double min_distance = tolerance;
  for (int i = 0; i < count; ++i) {
    const double d = distance(i);
    if (d <= min_distance) {
      min_distance = d;
      best = i;
    }
  }
  return best;
}

Eigen::Vector3d middleOfArc(const ModelCircle& c) {
  const double angle = c.start + 0.5 * c.sweep;
  return c.centre + c.radius * (std::cos(angle) * c.x_axis + std::sin(angle) * c.axis.cross(c.x_axis));
}

int copyOfCircle(const ObjectModel& model, const Rigid3& motion, const ModelCircle& circle) {
  return nearest(int(model.circles.size()), kCopyTolerance * model.diameter, [&](int i) {
    const ModelCircle& other = model.circles[i];
    if ((motion.rotation * circle.axis).cross(other.axis).norm() > 0.05 || circle.full() != other.full())
      return std::numeric_limits<double>::infinity();
    const double arc = circle.full() ? 0.0 : (motion * middleOfArc(circle) - middleOfArc(other)).norm();
    return (motion * circle.centre - other.centre).norm() + std::abs(circle.radius - other.radius) + arc;
  });
}

FeatureMap mapOf(const EdgeGraph& g, const Rigid3& motion) {
  const ObjectModel& model = g.model;
  FeatureMap map;
  for (const Eigen::Vector3d& p : g.points) {
    const Eigen::Vector3d copy = motion * p;
    map.point.push_back(nearest(int(g.points.size()), kCopyTolerance * model.diameter,
                                [&](int i) { return (g.points[i] - copy).norm(); }));
  }
  for (int e = 0; e < int(model.edges.size()); ++e) {
    const int a = map.point[g.point_of_end[2 * e]], b = map.point[g.point_of_end[2 * e + 1]];
    int copy = -1;
    if (a >= 0 && b >= 0)
      for (int end : g.ends_at[a])
        if (copy < 0 && g.point_of_end[end ^ 1] == b) copy = end / 2;
    map.edge.push_back(copy);
  }
  for (const ModelCircle& circle : model.circles) map.circle.push_back(copyOfCircle(model, motion, circle));
  return map;
}

/// A grouping as numbers, features in the order of `order`, carried along by a symmetry (null: as it is).
/// Empty when the symmetry has no copy of a feature.
std::vector<int> signature(const ModelGrouping& m, const std::vector<int>& points,
                           const Correspondence& order, const FeatureMap* map) {
  std::vector<int> result;
  for (size_t i = 0; i < points.size(); ++i) {
    const int point = points[order.points[i]];
    result.push_back(map ? map->point[point] : point);
  }
  for (size_t i = 0; i < m.edges.size(); ++i) {
    const int edge = m.edges[order.segments[i]];
    result.push_back(map ? map->edge[edge] : edge);
  }
  for (size_t i = 0; i < m.circles.size(); ++i) {
    const int circle = m.circles[order.ellipses[i]];
    result.push_back(map ? map->circle[circle] : circle);
  }
  if (std::find(result.begin(), result.end(), -1) != result.end()) result.clear();
  return result;
}

}  // namespace

std::vector<FeatureMap> mapFeatures(const EdgeGraph& graph) {
  std::vector<FeatureMap> maps;
  for (const Rigid3& motion : graph.model.symmetries.discrete) maps.push_back(mapOf(graph, motion));
  if (maps.empty()) maps.push_back(mapOf(graph, Rigid3{}));
  return maps;
}

std::vector<ModelGrouping> moduloSymmetries(const EdgeGraph& graph, const std::vector<FeatureMap>& maps,
                                            const std::vector<ModelGrouping>& groupings) {
  const auto pointId = [&](const Eigen::Vector3d& p) {
    return nearest(int(graph.points.size()), std::numeric_limits<double>::infinity(),
                   [&](int i) { return (graph.points[i] - p).norm(); });
  };

  std::vector<ModelGrouping> kept;
  std::set<std::vector<int>> seen;
  for (const ModelGrouping& m : groupings) {
    std::vector<int> points;
    for (const Eigen::Vector3d& p : m.points) points.push_back(pointId(p));
    const auto keyed = [&](std::vector<int> s) {
      s.push_back(int(m.kind));
      return s;
    };
    const std::vector<Correspondence> orders = ordersOf(m.kind, m.oriented);
    if (seen.count(keyed(signature(m, points, orders[0], nullptr)))) continue;

    ModelGrouping representative = m;
    std::set<std::vector<int>> own;  // orders of this grouping that are taken
    for (const Correspondence& order : orders) {
      if (!own.count(signature(m, points, order, nullptr))) representative.orders.push_back(order);
      for (const FeatureMap& map : maps) {
        const std::vector<int> copy = signature(m, points, order, &map);
        if (copy.empty()) continue;
        own.insert(copy);
        seen.insert(keyed(copy));
      }
      own.insert(signature(m, points, order, nullptr));
    }
    kept.push_back(std::move(representative));
  }
  return kept;
}

}  // namespace monocular_eye_hand
