#include "grouping/line_groupings.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <tuple>

namespace monocular_eye_hand {
namespace {

// A triplet is a T when the two outer segments are this near to one line [rad].
constexpr double kStraight = 0.15;
// How likely three segments of which two are in line are one object's corner and not one object before
// another.
constexpr double kTStructure = 0.3;
// How likely the ends of a three-sided figure are the corners of its missing side.
constexpr double kOpenStructure = 0.5;

int otherEnd(const Corner& corner, int end) { return corner.end_a == end ? corner.end_b : corner.end_a; }

/// Where an edge ends, with its standard deviation: the corner found there, else the segment's own end.
std::pair<Eigen::Vector2d, double> endOf(const ImageContext& c, const EndMap& map, int end) {
  const LineSegment& s = c.features.segments[end / 2];
  const double half = 0.5 * s.length();
  const double across2 = s.sigma_offset * s.sigma_offset + half * half * s.sigma_angle * s.sigma_angle;
  double along = end % 2 ? s.sigma_q : s.sigma_p;

  switch (map.state[end]) {
    case EndState::kBorder:
    case EndState::kContinued:
    case EndState::kStem:
      return {endPoint(c.features, end), std::max(kCutOffSigma, half)};
    case EndState::kCorner: {
      const Corner& best = map.corners[map.corners_of_end[end].front()];
      if (best.weight > 0.5) return {best.p, best.sigma};
      break;
    }
    case EndState::kFree:
      along = std::max(along, c.options.free_end_sigma);
      break;
  }
  return {endPoint(c.features, end), std::sqrt(0.5 * (along * along + across2))};
}

void addEnd(const ImageContext& c, const EndMap& map, int end, Grouping* g) {
  const auto [p, sigma] = endOf(c, map, end);
  g->points.push_back(p);
  g->sigma.push_back(sigma);
}

void addCorner(const Corner& corner, Grouping* g) {
  g->points.push_back(corner.p);
  g->sigma.push_back(corner.sigma);
}

/// The corner of two ends, or null.
const Corner* cornerOf(const EndMap& map, int a, int b) {
  for (int i : map.corners_of_end[a])
    if (otherEnd(map.corners[i], a) == b) return &map.corners[i];
  return nullptr;
}

bool continuedBy(const EndMap& map, int a, int b) {
  return std::binary_search(map.continued_by[a].begin(), map.continued_by[a].end(), b);
}

/// The point nearest three lines, its covariance's mean standard deviation, and how badly they miss each
/// other (chi-square with one degree of freedom).
struct Meeting {
  Eigen::Vector2d p;
  double sigma = 0, chi2 = 0;
};
Meeting meetingOf(const ImageContext& c, const std::array<int, 3>& ends) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  std::array<Eigen::Vector2d, 3> n, e;
  std::array<double, 3> weight;
  for (int i = 0; i < 3; ++i) {
    const LineSegment& s = c.features.segments[ends[i] / 2];
    const Eigen::Vector2d d = outward(c.features, ends[i]);
    const double half = 0.5 * s.length();
    n[i] = {d.y(), -d.x()};
    e[i] = endPoint(c.features, ends[i]);
    // Detected lines of a corner bend by a fraction of a pixel where they meet: floor of the deviation.
    weight[i] = 1.0 / (s.sigma_offset * s.sigma_offset + half * half * s.sigma_angle * s.sigma_angle + 0.25);
    normal += weight[i] * n[i] * n[i].transpose();
    right += weight[i] * n[i] * n[i].dot(e[i]);
  }

  Meeting m;
  const Eigen::Matrix2d covariance = normal.inverse();
  m.p = covariance * right;
  m.sigma = std::sqrt(0.5 * covariance.trace());
  for (int i = 0; i < 3; ++i) m.chi2 += weight[i] * std::pow(n[i].dot(m.p - e[i]), 2);
  return m;
}

/// Arrow, Y or T by the widest gap between the directions (sorted by angle).
GroupingShape tripletShape(const std::array<double, 3>& angle) {
  const double widest = std::max({angle[1] - angle[0], angle[2] - angle[1], angle[0] + 2 * M_PI - angle[2]});
  if (std::abs(widest - M_PI) < kStraight) return GroupingShape::kT;
  return widest > M_PI ? GroupingShape::kArrow : GroupingShape::kY;
}

void addTriplet(const ImageContext& c, const EndMap& map, std::array<int, 3> ends, double weight,
                std::vector<Grouping>* out) {
  const Meeting meeting = meetingOf(c, ends);
  const auto angleOf = [&](int end) {
    const Eigen::Vector2d d = -outward(c.features, end);
    return std::atan2(d.y(), d.x());
  };
  std::sort(ends.begin(), ends.end(),
            [&](int a, int b) { return std::make_pair(angleOf(a), a) < std::make_pair(angleOf(b), b); });

  Grouping g;
  g.kind = GroupingKind::kTriplet;
  g.shape = tripletShape({angleOf(ends[0]), angleOf(ends[1]), angleOf(ends[2])});
  g.points.push_back(meeting.p);
  g.sigma.push_back(meeting.sigma);
  for (int end : ends) {
    g.segments.push_back(end / 2);
    addEnd(c, map, end ^ 1, &g);
  }

  g.weight = closedWeight(weight * std::exp(-0.5 * meeting.chi2));
  if (g.shape == GroupingShape::kT) g.weight *= kTStructure;
  g.weight = clampWeight(g.weight);
  out->push_back(std::move(g));
}

/// The ends that make corners with `end` or continue it, and lie after it in number: ascending.
std::vector<int> partners(const EndMap& map, int end) {
  std::vector<int> result;
  for (int i : map.corners_of_end[end]) result.push_back(otherEnd(map.corners[i], end));
  result.insert(result.end(), map.continued_by[end].begin(), map.continued_by[end].end());
  result.erase(std::remove_if(result.begin(), result.end(), [&](int other) { return other < end; }),
               result.end());
  std::sort(result.begin(), result.end());
  return result;
}

/// Weight of the meeting of two of a triplet's ends: a corner's, or that of a line which goes on; 0: neither.
double meetingWeight(const ImageContext& c, const EndMap& map, int a, int b) {
  if (const Corner* corner = cornerOf(map, a, b)) return corner->weight;
  if (continuedBy(map, a, b)) return c.segment_weight[a / 2] * c.segment_weight[b / 2];
  return 0;
}

}  // namespace

std::vector<Grouping> edgeGroupings(const ImageContext& c, const EndMap& map) {
  std::vector<Grouping> result;
  for (int s = 0; s < int(c.features.segments.size()); ++s) {
    Grouping g;
    g.kind = GroupingKind::kEdge;
    g.segments = {s};
    addEnd(c, map, 2 * s, &g);
    addEnd(c, map, 2 * s + 1, &g);
    g.weight =
        clampWeight(c.segment_weight[s] * endWeight(map.state[2 * s]) * endWeight(map.state[2 * s + 1]));
    result.push_back(std::move(g));
  }
  return result;
}

std::vector<Grouping> junctionGroupings(const ImageContext& c, const EndMap& map) {
  std::vector<Grouping> result;
  for (const Corner& corner : map.corners) {
    Grouping g;
    g.kind = GroupingKind::kJunction;
    g.segments = {corner.end_a / 2, corner.end_b / 2};
    addEnd(c, map, corner.end_a ^ 1, &g);
    addCorner(corner, &g);
    addEnd(c, map, corner.end_b ^ 1, &g);
    g.weight = corner.weight;

    // A stem and the line it runs into meet by occlusion more often than by structure; so do lines that go
    // on.
    for (int end : {corner.end_a, corner.end_b})
      if (map.state[end] == EndState::kStem || map.state[end] == EndState::kContinued)
        g.weight *= kTStructure;
    g.weight = clampWeight(g.weight);
    result.push_back(std::move(g));
  }
  return result;
}

std::vector<Grouping> tripletGroupings(const ImageContext& c, const EndMap& map) {
  std::vector<Grouping> result;
  for (int a = 0; a < int(map.state.size()); ++a) {
    const std::vector<int> others = partners(map, a);
    for (size_t i = 0; i < others.size(); ++i)
      for (size_t j = i + 1; j < others.size(); ++j) {
        const int b = others[i], d = others[j];
        if (c.related(b / 2, d / 2)) continue;
        const double ab = meetingWeight(c, map, a, b), ad = meetingWeight(c, map, a, d);
        const double bd = meetingWeight(c, map, b, d);
        // Geometric mean of the three meetings, as two of them: the third follows from them.
        if (ab * ad * bd > 0) addTriplet(c, map, {a, b, d}, std::pow(ab * ad * bd, 2.0 / 3.0), &result);
      }
  }
  return result;
}

std::vector<Grouping> chainGroupings(const ImageContext& c, const EndMap& map) {
  std::vector<Grouping> result;
  for (int s = 0; s < int(c.features.segments.size()); ++s)
    for (int i : map.corners_of_end[2 * s])
      for (int j : map.corners_of_end[2 * s + 1]) {
        const Corner &first = map.corners[i], &second = map.corners[j];
        const int a = otherEnd(first, 2 * s), b = otherEnd(second, 2 * s + 1);
        if (c.related(a / 2, b / 2)) continue;

        Grouping g;
        g.kind = GroupingKind::kChain;
        g.segments = {a / 2, s, b / 2};
        addEnd(c, map, a ^ 1, &g);
        addCorner(first, &g);
        addCorner(second, &g);
        addEnd(c, map, b ^ 1, &g);

        const Eigen::Vector2d shared = second.p - first.p;
        const double side_a = cross(shared, g.points[0] - first.p);
        const double side_b = cross(shared, g.points[3] - second.p);
        g.shape = side_a * side_b > 0 ? GroupingShape::kU : GroupingShape::kZ;
        // The shared segment is counted in both corners.
        g.weight = clampWeight(first.weight * second.weight / c.segment_weight[s]);
        result.push_back(std::move(g));
      }
  return result;
}

int turningSense(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                 const Eigen::Vector2d& d) {
  const double turns[4] = {cross(b - a, c - b), cross(c - b, d - c), cross(d - c, a - d),
                           cross(a - d, b - a)};
  const auto [low, high] = std::minmax_element(turns, turns + 4);
  if (*low > 0) return 1;
  return *high < 0 ? -1 : 0;
}

std::vector<Grouping> openQuadGroupings(const std::vector<Grouping>& chains) {
  std::vector<Grouping> result;
  for (const Grouping& chain : chains) {
    if (chain.shape != GroupingShape::kU) continue;
    if (chain.sigma[0] >= kCutOffSigma || chain.sigma[3] >= kCutOffSigma) continue;
    const int sense = turningSense(chain.points[0], chain.points[1], chain.points[2], chain.points[3]);
    if (sense == 0) continue;

    Grouping g = chain;
    g.kind = GroupingKind::kQuad;
    g.shape = GroupingShape::kOpen;
    g.weight = clampWeight(kOpenStructure * chain.weight);
    if (sense < 0) {
      std::reverse(g.points.begin(), g.points.end());
      std::reverse(g.sigma.begin(), g.sigma.end());
      std::reverse(g.segments.begin(), g.segments.end());
    }
    result.push_back(std::move(g));
  }
  return result;
}

namespace {

/// A closed ring of four corners; ends[i] leaves corner i, its segment's other end arrives at corner i + 1.
void addClosedQuad(const ImageContext& c, const std::array<int, 4>& segments,
                   const std::array<const Corner*, 4>& corners, std::vector<Grouping>* out) {
  const int sense = turningSense(corners[0]->p, corners[1]->p, corners[2]->p, corners[3]->p);
  if (sense == 0) return;
  Grouping g;
  g.kind = GroupingKind::kQuad;
  g.shape = GroupingShape::kClosed;
  double weight = 1;
  for (int k = 0; k < 4; ++k) {
    const int i = sense > 0 ? k : (4 - k) % 4;  // corner
    const int side = sense > 0 ? k : (3 - k);   // the side from it to the next corner
    addCorner(*corners[i], &g);
    g.segments.push_back(segments[side]);
    weight *= corners[i]->weight / c.segment_weight[segments[i]];  // every segment is counted in two corners
  }
  g.weight = clampWeight(closedWeight(std::min(1.0, weight)));
  out->push_back(std::move(g));
}

}  // namespace

std::vector<Grouping> closedQuadGroupings(const ImageContext& c, const EndMap& map) {
  std::vector<Grouping> result;
  const int count = int(c.features.segments.size());

  // Every ring once: s has the smallest number, and its p comes before its q.
  for (int s = 0; s < count; ++s)
    for (int i : map.corners_of_end[2 * s + 1])
      for (int j : map.corners_of_end[2 * s]) {
        const int right = otherEnd(map.corners[i], 2 * s + 1), left = otherEnd(map.corners[j], 2 * s);
        if (right / 2 < s || left / 2 < s || c.related(right / 2, left / 2)) continue;
        for (int k : map.corners_of_end[right ^ 1]) {
          const int top = otherEnd(map.corners[k], right ^ 1);
          if (top / 2 < s || c.related(top / 2, s) || c.related(top / 2, left / 2)) continue;
          const Corner* last = cornerOf(map, left ^ 1, top ^ 1);
          if (last == nullptr) continue;
          addClosedQuad(c, {s, right / 2, top / 2, left / 2},
                        {&map.corners[j], &map.corners[i], &map.corners[k], last}, &result);
        }
      }
  return result;
}

void keepBest(std::vector<Grouping>* groupings, int limit) {
  std::vector<int> order(groupings->size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = int(i);
  const auto before = [&](int i, int j) {
    const Grouping &a = (*groupings)[i], &b = (*groupings)[j];
    if (a.weight != b.weight) return a.weight > b.weight;
    return std::tie(a.segments, a.ellipses, i) < std::tie(b.segments, b.ellipses, j);
  };
  const size_t kept = std::min<size_t>(order.size(), limit);
  std::partial_sort(order.begin(), order.begin() + kept, order.end(), before);
  std::vector<Grouping> best;
  best.reserve(kept);
  for (size_t i = 0; i < kept; ++i) best.push_back(std::move((*groupings)[order[i]]));
  *groupings = std::move(best);
}

}  // namespace monocular_eye_hand
