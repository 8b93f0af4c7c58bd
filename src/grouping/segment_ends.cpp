#include "grouping/segment_ends.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "grouping/image_context.h"
#include "grouping/weights.h"

namespace monocular_eye_hand {
namespace {

// Half width of the strip in which two pieces count as one line [px]; the lines' own uncertainty is added.
constexpr double kLineStrip = 1.5;
// Longest gap between an end and its continuation when the segments are short [px].
constexpr double kShortestContinuation = 6.0;
// A break of a line is bridged up to this share of the two lengths (as the joining of segments does).
constexpr double kContinuationRatio = 0.4;

double cornerLimit(const GroupingOptions& o, double shorter) {
  return std::max(3.0, std::min(o.corner_gap, o.corner_gap_ratio * shorter));
}

/// Variance of a segment's line across itself at distance `along` from its middle [px^2].
double lineVariance(const LineSegment& s, double along) {
  return s.sigma_offset * s.sigma_offset + along * along * s.sigma_angle * s.sigma_angle;
}

bool atBorder(const FeatureSet& f, const Eigen::Vector2d& uv_rect, double margin) {
  const Eigen::Vector2d uv = f.camera.distort(uv_rect);
  return uv.x() < margin || uv.y() < margin || uv.x() > f.camera.width - 1 - margin ||
         uv.y() > f.camera.height - 1 - margin;
}

/// The corner of two ends, if their lines meet near both (sub-pixel intersection of the lines).
bool meet(const ImageContext& c, int end_a, int end_b, Corner* corner) {
  const LineSegment &a = c.features.segments[end_a / 2], &b = c.features.segments[end_b / 2];
  const Eigen::Vector2d da = outward(c.features, end_a), db = outward(c.features, end_b);
  const double sine = cross(da, db);
  if (std::abs(sine) < std::sin(c.options.min_corner_angle)) return false;

  const Eigen::Vector2d ea = endPoint(c.features, end_a), eb = endPoint(c.features, end_b);
  const double gap_a = cross(eb - ea, db) / sine;  // along da, negative when the segment runs past the corner
  const Eigen::Vector2d p = ea + gap_a * da;
  const double gap_b = (p - eb).dot(db);
  const double gap = std::max(std::abs(gap_a), std::abs(gap_b));
  if (gap > cornerLimit(c.options, std::min(a.length(), b.length()))) return false;

  corner->end_a = end_a;
  corner->end_b = end_b;
  corner->p = p;
  // Each line leaves the corner a variance across itself; p solves both lines: trace of its covariance is
  // (v_a + v_b) / sin^2.
  const double variance =
      lineVariance(a, 0.5 * a.length() + gap_a) + lineVariance(b, 0.5 * b.length() + gap_b);
  corner->sigma = std::sqrt(0.5 * variance) / std::abs(sine);
  corner->weight = clampWeight(cornerWeight(gap, c.grid.endDensity(p, 2.0)) * c.segment_weight[end_a / 2] *
                               c.segment_weight[end_b / 2]);
  return true;
}

/// True when end_b's segment goes on where end_a's stops: same line, facing ends.
bool continues(const ImageContext& c, int end_a, int end_b) {
  const LineSegment &a = c.features.segments[end_a / 2], &b = c.features.segments[end_b / 2];
  const Eigen::Vector2d da = outward(c.features, end_a), db = outward(c.features, end_b);
  const double strip = kLineStrip + 2.0 * (a.sigma_offset + b.sigma_offset);
  if (da.dot(db) > -std::cos(0.5 * c.options.min_corner_angle)) return false;
  const Eigen::Vector2d gap = endPoint(c.features, end_b) - endPoint(c.features, end_a);
  const double longest =
      std::max(kShortestContinuation, kContinuationRatio * std::min(a.length(), b.length()));
  return std::abs(cross(da, gap)) < strip && std::abs(cross(db, gap)) < strip && da.dot(gap) > -3.0 &&
         da.dot(gap) < longest;
}

void findMeetings(const ImageContext& c, EndMap* map) {
  const int ends = 2 * int(c.features.segments.size());
  // Two ends of one corner are at most a limit each from it.
  const double reach = 2.0 * std::max(3.0, c.options.corner_gap);
  std::vector<std::tuple<double, int, int>> going_on;  // gap, ends
  std::vector<int> near;
  for (int a = 0; a < ends; ++a) {
    c.grid.endsNear(endPoint(c.features, a), reach, &near);
    for (int b : near) {
      if (b <= a || c.related(a / 2, b / 2)) continue;
      Corner corner;
      if (meet(c, a, b, &corner)) {
        map->corners.push_back(corner);
      } else if (continues(c, a, b)) {
        going_on.push_back({(endPoint(c.features, a) - endPoint(c.features, b)).norm(), a, b});
      }
    }
  }

  // The nearest count: a bundle of lines through one point would otherwise pair each with each.
  std::sort(going_on.begin(), going_on.end());
  const size_t max_corners = size_t(c.options.max_corners_per_end);
  for (const auto& [gap, a, b] : going_on) {
    if (map->continued_by[a].size() >= max_corners || map->continued_by[b].size() >= max_corners) continue;
    map->continued_by[a].push_back(b);
    map->continued_by[b].push_back(a);
  }
}

/// Keeps, per end, the best corners; a corner stays when it is among the best of both its ends.
void keepBestCorners(const ImageContext& c, EndMap* map) {
  const auto fill = [&] {
    for (std::vector<int>& list : map->corners_of_end) list.clear();
    for (int i = 0; i < int(map->corners.size()); ++i) {
      map->corners_of_end[map->corners[i].end_a].push_back(i);
      map->corners_of_end[map->corners[i].end_b].push_back(i);
    }
    for (std::vector<int>& list : map->corners_of_end)
      std::stable_sort(list.begin(), list.end(),
                       [&](int i, int j) { return map->corners[i].weight > map->corners[j].weight; });
  };

  fill();
  std::vector<int> votes(map->corners.size(), 0);
  for (const std::vector<int>& list : map->corners_of_end)
    for (int k = 0; k < std::min<int>(list.size(), c.options.max_corners_per_end); ++k) ++votes[list[k]];

  std::vector<Corner> kept;
  for (size_t i = 0; i < map->corners.size(); ++i)
    if (votes[i] == 2) kept.push_back(map->corners[i]);
  map->corners = std::move(kept);
  fill();
}

/// The side of which segment does this end run into? -1: none.
int barOf(const ImageContext& c, int end, std::vector<int>* near) {
  const Eigen::Vector2d e = endPoint(c.features, end), d = outward(c.features, end);
  const double limit = cornerLimit(c.options, c.features.segments[end / 2].length());
  c.grid.segmentsNear(e, limit, near);
  for (int s : *near) {
    if (c.related(s, end / 2)) continue;
    const LineSegment& bar = c.features.segments[s];
    const Eigen::Vector2d along = bar.direction();
    const double sine = cross(d, along);
    if (std::abs(sine) < std::sin(c.options.min_corner_angle)) continue;
    const double gap = cross(bar.p - e, along) / sine;
    if (std::abs(gap) > limit) continue;
    const double at = along.dot(e + gap * d - bar.p);
    const double corner =
        cornerLimit(c.options, std::min(bar.length(), c.features.segments[end / 2].length()));
    if (at > corner && at < bar.length() - corner) return s;
  }
  return -1;
}

/// Does this end meet an end that is no part of the bar it runs into?
bool meetsBesides(const ImageContext& c, const EndMap& map, int end, const Eigen::Vector2d& bar_direction) {
  for (int i : map.corners_of_end[end]) {
    const Corner& corner = map.corners[i];
    const int other = corner.end_a == end ? corner.end_b : corner.end_a;
    if (std::abs(cross(outward(c.features, other), bar_direction)) > std::sin(c.options.min_corner_angle))
      return true;
  }
  return false;
}

/// A line that breaks where this end arrives is a bar as well.
bool brokenBar(const ImageContext& c, const EndMap& map, int end, Eigen::Vector2d* direction) {
  for (int i : map.corners_of_end[end]) {
    const Corner& corner = map.corners[i];
    const int other = corner.end_a == end ? corner.end_b : corner.end_a;
    if (map.continued_by[other].empty() && !c.insideJoined(other)) continue;
    *direction = outward(c.features, other);
    return true;
  }
  return false;
}

EndState stateOf(const ImageContext& c, const EndMap& map, int end, std::vector<int>* near) {
  if (atBorder(c.features, endPoint(c.features, end), c.options.border_margin)) return EndState::kBorder;
  if (!map.continued_by[end].empty() || c.insideJoined(end)) return EndState::kContinued;
  Eigen::Vector2d bar_direction;
  const int bar = barOf(c, end, near);
  if (bar >= 0) bar_direction = c.features.segments[bar].direction();
  if (bar >= 0 || brokenBar(c, map, end, &bar_direction))
    return meetsBesides(c, map, end, bar_direction) ? EndState::kCorner : EndState::kStem;
  return map.corners_of_end[end].empty() ? EndState::kFree : EndState::kCorner;
}

}  // namespace

EndMap mapEnds(const ImageContext& c) {
  const int ends = 2 * int(c.features.segments.size());
  EndMap map;
  map.corners_of_end.resize(ends);
  map.continued_by.resize(ends);
  map.state.resize(ends);
  findMeetings(c, &map);
  for (std::vector<int>& list : map.continued_by) std::sort(list.begin(), list.end());
  keepBestCorners(c, &map);
  std::vector<int> near;
  for (int end = 0; end < ends; ++end) map.state[end] = stateOf(c, map, end, &near);
  return map;
}

EndMap mapEnds(const FeatureSet& features, const GroupingOptions& options) {
  return mapEnds(ImageContext(features, options));
}

}  // namespace monocular_eye_hand
