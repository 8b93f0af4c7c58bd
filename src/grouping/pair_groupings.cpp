#include "grouping/pair_groupings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace monocular_eye_hand {
namespace {

// Parallel lines nearer than this are one broad or doubled edge [px].
constexpr double kDoubleEdge = 2.0;
// How far an ellipse's line may be even when the ellipse is small [px].
constexpr double kSmallEllipseReach = 60.0;
// Axis ratio above which an ellipse's orientation says nothing about its axis.
constexpr double kNearlyRound = 0.85;
// How likely two segments that only lie side by side, or near an ellipse, belong together.
constexpr double kSideBySide = 0.5;

/// The angle of an undirected line or axis, in [0, pi).
double lineAngle(const Eigen::Vector2d& d) {
  const double angle = std::atan2(d.y(), d.x());
  return angle < 0 ? angle + M_PI : (angle >= M_PI ? angle - M_PI : angle);
}
double lineAngleDifference(double a, double b) {
  const double d = std::fmod(std::abs(a - b), M_PI);
  return std::min(d, M_PI - d);
}

/// How well two parallel segments lie side by side: 0 not at all .. 1.
double sideBySide(const GroupingOptions& o, const LineSegment& a, const LineSegment& b) {
  const double longer = std::max(a.length(), b.length()), shorter = std::min(a.length(), b.length());
  const Eigen::Vector2d along = a.length() >= b.length() ? a.direction() : b.direction();
  const Eigen::Vector2d between = 0.5 * (b.p + b.q - a.p - a.q);
  const double distance = std::abs(along.x() * between.y() - along.y() * between.x());
  if (distance < kDoubleEdge || distance > o.parallel_distance_ratio * longer) return 0;
  const double a0 = std::min(along.dot(a.p), along.dot(a.q)), a1 = std::max(along.dot(a.p), along.dot(a.q));
  const double b0 = std::min(along.dot(b.p), along.dot(b.q)), b1 = std::max(along.dot(b.p), along.dot(b.q));
  const double overlap = (std::min(a1, b1) - std::max(a0, b0)) / shorter;
  if (overlap < o.parallel_overlap) return 0;
  return std::min(1.0, overlap) * shorter / longer / (1.0 + distance / longer);
}

struct Pair {
  int a, b;
  double fit;
};

/// Keeps pairs that are among the best of both partners.
std::vector<Pair> bestOfBoth(std::vector<Pair> pairs, int count_a, int count_b, int limit) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return x.fit > y.fit; });
  std::vector<int> used_a(count_a, 0), used_b(count_b, 0);
  std::vector<Pair> kept;
  for (const Pair& pair : pairs) {
    if (used_a[pair.a] >= limit || used_b[pair.b] >= limit) continue;
    ++used_a[pair.a];
    ++used_b[pair.b];
    kept.push_back(pair);
  }
  return kept;
}

}  // namespace

std::vector<Grouping> parallelGroupings(const ImageContext& c, const std::vector<Grouping>& edges) {
  const std::vector<LineSegment>& segments = c.features.segments;
  const int count = int(segments.size());
  std::vector<double> angle(count);
  for (int s = 0; s < count; ++s) angle[s] = lineAngle(segments[s].q - segments[s].p);
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return angle[i] < angle[j]; });

  // Only the window of similar angles is looked at, going round at pi.
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i)
    for (int k = 1; k < count; ++k) {
      const int j = (i + k) % count;
      const double turn = angle[order[j]] - angle[order[i]] + (j < i ? M_PI : 0.0);
      if (turn > c.options.parallel_angle) break;
      const int a = std::min(order[i], order[j]), b = std::max(order[i], order[j]);
      const double fit = sideBySide(c.options, segments[a], segments[b]);
      if (fit > 0 && !c.related(a, b))
        pairs.push_back({a, b, fit * c.segment_weight[a] * c.segment_weight[b]});
    }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& x, const Pair& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
  std::vector<Grouping> result;
  for (const Pair& pair : bestOfBoth(std::move(pairs), count, count, c.options.max_pairs_per_feature)) {
    Grouping g;
    g.kind = GroupingKind::kParallelPair;
    g.segments = std::vector<int>{pair.a, pair.b};
    const Grouping &ea = edges[pair.a], &eb = edges[pair.b];
    const int first = segments[pair.a].direction().dot(segments[pair.b].direction()) > 0 ? 0 : 1;
    g.points = {ea.points[0], ea.points[1], eb.points[first], eb.points[1 - first]};
    g.sigma = {ea.sigma[0], ea.sigma[1], eb.sigma[first], eb.sigma[1 - first]};
    g.weight = clampWeight(kSideBySide * pair.fit);
    result.push_back(std::move(g));
  }
  return result;
}

std::vector<Grouping> ellipseGroupings(const ImageContext& c) {
  std::vector<Grouping> result;
  for (int e = 0; e < int(c.features.ellipses.size()); ++e) {
    Grouping g;
    g.kind = GroupingKind::kEllipse;
    g.ellipses = std::vector<int>{e};
    g.weight = ellipseWeight(c.features.ellipses[e]);
    result.push_back(std::move(g));
  }
  return result;
}

namespace {

/// How well two ellipses can be circles about one axis seen from afar: alike in shape and direction, centres
/// along the common minor axis (the image of the axis). 0 not at all .. 1.
double commonAxis(const GroupingOptions& o, const Ellipse& a, const Ellipse& b) {
  const double ratio_a = a.b / a.a, ratio_b = b.b / b.a, larger = std::max(a.a, b.a);
  const double shape = std::abs(ratio_a - ratio_b);
  if (shape > o.ellipse_axis_tolerance) return 0;
  const Eigen::Vector2d offset = b.centre - a.centre;
  double turn = 0, miss = 0;
  if (std::max(ratio_a, ratio_b) < kNearlyRound) {
    turn = lineAngleDifference(a.angle, b.angle);
    if (turn > o.ellipse_axis_tolerance) return 0;
    const double angle = a.a >= b.a ? a.angle : b.angle;  // the larger one's direction is the better known
    miss = std::abs(offset.dot(Eigen::Vector2d(std::cos(angle), std::sin(angle)))) / larger;
  }
  if (miss > o.ellipse_axis_tolerance || offset.norm() > o.ellipse_reach * larger) return 0;
  return std::exp(-(shape + turn + miss) / o.ellipse_axis_tolerance) / (1.0 + offset.norm() / larger);
}

}  // namespace

std::vector<Grouping> ellipsePairGroupings(const ImageContext& c) {
  const std::vector<DetectedEllipse>& ellipses = c.features.ellipses;
  const int count = int(ellipses.size());
  std::vector<Pair> pairs;
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      const double fit = commonAxis(c.options, ellipses[a].ellipse, ellipses[b].ellipse);
      if (fit > 0) pairs.push_back({a, b, fit * ellipseWeight(ellipses[a]) * ellipseWeight(ellipses[b])});
    }
  std::vector<Grouping> result;
  for (const Pair& pair : bestOfBoth(std::move(pairs), count, count, c.options.max_pairs_per_feature)) {
    Grouping g;
    g.kind = GroupingKind::kEllipsePair;
    g.ellipses = std::vector<int>{pair.a, pair.b};
    g.weight = clampWeight(pair.fit);
    result.push_back(std::move(g));
  }
  return result;
}

std::vector<Grouping> ellipseLineGroupings(const ImageContext& c, const std::vector<Grouping>& edges) {
  std::vector<Pair> pairs;
  const int ellipse_count = int(c.features.ellipses.size()), segment_count = int(c.features.segments.size());
  for (int e = 0; e < ellipse_count; ++e) {
    const DetectedEllipse& ellipse = c.features.ellipses[e];
    const double reach = std::max(c.options.ellipse_reach * ellipse.ellipse.a, kSmallEllipseReach);
    for (int s = 0; s < segment_count; ++s) {
      const LineSegment& segment = c.features.segments[s];
      const Eigen::Vector2d along = segment.q - segment.p;
      const double t =
          std::clamp((ellipse.ellipse.centre - segment.p).dot(along) / along.squaredNorm(), 0.0, 1.0);
      const double distance = (segment.p + t * along - ellipse.ellipse.centre).norm();
      if (distance < reach)
        pairs.push_back({e, s, (1.0 - distance / reach) * ellipseWeight(ellipse) * edges[s].weight});
    }
  }

  std::vector<Grouping> result;
  for (const Pair& pair :
       bestOfBoth(std::move(pairs), ellipse_count, segment_count, c.options.max_pairs_per_feature)) {
    Grouping g;
    g.kind = GroupingKind::kEllipseLine;
    g.ellipses = std::vector<int>{pair.a};
    g.segments = std::vector<int>{pair.b};
    g.points = edges[pair.b].points;
    g.sigma = edges[pair.b].sigma;
    g.weight = clampWeight(kSideBySide * pair.fit);
    result.push_back(std::move(g));
  }
  return result;
}

}  // namespace monocular_eye_hand
