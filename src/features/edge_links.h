#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "monocular_eye_hand/features/edge_detection.h"

namespace monocular_eye_hand {

/// Links between edge points while they are being made; every point has at most one successor and one
/// predecessor.
struct EdgeLinks {
  static constexpr float kNone = 1e9f;
  void reset(size_t points) {
    next.assign(points, -1);
    previous.assign(points, -1);
    cost.assign(points, kNone);
  }
  std::vector<int> next, previous;  ///< -1: none
  std::vector<float> cost;          ///< of the link to the successor

  void link(int from, int to, float link_cost) {
    next[from] = to;
    previous[to] = from;
    cost[from] = link_cost;
  }
  void unlink(int from, int to) {
    next[from] = -1;
    previous[to] = -1;
    cost[from] = kNone;
  }
};

/// Whether q continues p (order 1), p continues q (-1) or neither (0), and what the link would cost: distance
/// plus departure from both tangents.
struct PairLink {
  int order = 0;
  float cost = EdgeLinks::kNone;
};
inline PairLink linkOf(const EdgePoint& p, const EdgePoint& q) {
  constexpr float kLeastStep = 0.2f, kLeastCosine = 0.3f, kAsideWeight = 1.5f;
  const float dx = q.uv.x() - p.uv.x(), dy = q.uv.y() - p.uv.y();
  const float px = p.normal.x(), py = p.normal.y(), qx = q.normal.x(), qy = q.normal.y();
  const float forward_p = px * dy - py * dx, forward_q = qx * dy - qy * dx;
  const bool after = forward_p >= kLeastStep && forward_q >= kLeastStep;
  const bool before = forward_p <= -kLeastStep && forward_q <= -kLeastStep;
  if (!(after || before) || px * qx + py * qy < kLeastCosine) return {};
  const float aside = std::fabs(px * dx + py * dy) + std::fabs(qx * dx + qy * dy);
  return {after ? 1 : -1, std::sqrt(dx * dx + dy * dy) + kAsideWeight * aside};
}

/// The cheapest neighbour of a point on one side.
struct Choice {
  int point = -1;
  float cost = EdgeLinks::kNone;
  void consider(int candidate, float candidate_cost) {
    if (candidate_cost < cost) point = candidate, cost = candidate_cost;
  }
};
struct Choices {
  Choice ahead, behind;
  void consider(int candidate, const PairLink& pair) {
    if (pair.order > 0) ahead.consider(candidate, pair.cost);
    if (pair.order < 0) behind.consider(candidate, pair.cost);
  }
};

/// Links points that choose each other: each takes the cheapest neighbour ahead and behind, on the ring of
/// pixels around it if there is one, else on the next ring. `choices` becomes what each point chose.
void linkMutualChoices(const EdgeMap& edges, std::vector<Choices>* choices, EdgeLinks* links);

/// Gives points without a link where they chose a neighbour another try at both rings; a cheaper link takes a
/// neighbour over.
void linkByClaims(const EdgeMap& edges, const std::vector<Choices>& choices, EdgeLinks* links);

/// First points of traces, and where they lie.
struct LooseStarts {
  std::vector<int> points;
  EdgePixels pixels;  ///< places in `points`
};

/// Links loose ends with loose starts nearby: across a gap of a few pixels, or over an end point that lies
/// beside the other trace's start instead of before it. `starts` becomes the loose starts there were.
void bridgeGaps(const EdgeMap& edges, LooseStarts* starts, EdgeLinks* links);

}  // namespace monocular_eye_hand
