#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "features/edge_detection.h"

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

/// Whether q continues p (order 1), p continues q (-1) or neither (0), and what a link would cost: distance
/// plus departure from both tangents.
struct PairLink {
  int order = 0;
  float cost = EdgeLinks::kNone;
};
inline PairLink linkOf(const EdgePoint& p, const EdgePoint& q) {
  constexpr float kMinStep = 0.2f, kMinCosine = 0.3f, kAsideWeight = 1.5f;
  const float dx = q.uv.x() - p.uv.x(), dy = q.uv.y() - p.uv.y();
  const float px = p.normal.x(), py = p.normal.y(), qx = q.normal.x(), qy = q.normal.y();
  const float forward_p = px * dy - py * dx, forward_q = qx * dy - qy * dx;
  // Which holds cannot be foreseen: everything is computed, nothing branches.
  const int after = int(forward_p >= kMinStep) & int(forward_q >= kMinStep);
  const int before = int(forward_p <= -kMinStep) & int(forward_q <= -kMinStep);
  const int alike = int(px * qx + py * qy >= kMinCosine);
  const float aside = std::fabs(px * dx + py * dy) + std::fabs(qx * dx + qy * dy);
  return {(after - before) * alike, std::sqrt(dx * dx + dy * dy) + kAsideWeight * aside};
}

/// The cheapest neighbour of a point on one side; of two that cost the same, the first. Cost and point in one
/// number, because which is cheaper cannot be foreseen and a minimum needs no branch.
class Choice {
 public:
  using Key = uint64_t;
  static constexpr Key kNobody = Key(-1);
  // The bits of positive floats are in the order of their values.
  static Key keyOf(int point, float cost) {
    uint32_t bits;
    std::memcpy(&bits, &cost, sizeof(bits));
    return Key(bits) << 32 | uint32_t(point);
  }
  void consider(Key candidate) { key_ = std::min(key_, candidate); }
  bool made() const { return key_ != kNobody; }
  int point() const { return int(uint32_t(key_)); }
  float cost() const {
    const uint32_t bits = uint32_t(key_ >> 32);
    float cost;
    std::memcpy(&cost, &bits, sizeof(cost));
    return cost;
  }

 private:
  Key key_ = kNobody;
};
struct Choices {
  Choice ahead, behind;
  void consider(int candidate, const PairLink& pair) {
    const Choice::Key key = Choice::keyOf(candidate, pair.cost);
    ahead.consider(pair.order > 0 ? key : Choice::kNobody);
    behind.consider(pair.order < 0 ? key : Choice::kNobody);
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
