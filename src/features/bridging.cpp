#include <algorithm>

#include "features/edge_links.h"
#include "features/pixel_rings.h"

namespace monocular_eye_hand {
namespace {

class Bridges {
 public:
  Bridges(const EdgeMap& edges, LooseStarts* starts, EdgeLinks* links)
      : edges_(edges), links_(*links), starts_(*starts) {
    starts_.points.clear();
    starts_.pixels.reset(edges.cols, edges.rows);
    for (int i = 0; i < int(edges.points.size()); ++i) {
      if (!looseStart(i)) continue;
      starts_.pixels.add(edges.x[i], edges.y[i], int32_t(starts_.points.size()));
      starts_.points.push_back(i);
    }
  }

  void build() {  // makes no new loose starts
    for (int i = 0; i < int(edges_.points.size()); ++i)
      if (looseEnd(i)) bridge(i);
  }

 private:
  // Ends of at least three points: noise makes shorter ones by the thousand.
  bool looseStart(int i) const {
    const int second = links_.next[i];
    return links_.previous[i] < 0 && second >= 0 && links_.next[second] >= 0;
  }
  bool looseEnd(int i) const {
    const int second = links_.previous[i];
    return links_.next[i] < 0 && second >= 0 && links_.previous[second] >= 0;
  }

  void bridge(int i) {
    constexpr int kReach = 4;
    int from = -1, to = -1, skipped = -1;
    float best = EdgeLinks::kNone;
    const auto consider = [&](int j) {
      if (!looseStart(j) || !roughlyAhead(i, j)) return;
      for (int a : {i, links_.previous[i]})
        for (int b : {j, links_.next[j]}) {
          if (a == b) continue;
          const PairLink pair = linkOf(edges_.points[a], edges_.points[b]);
          if (pair.order <= 0 || pair.cost >= best || !inLine(a, b)) continue;
          best = pair.cost;
          from = a;
          to = b;
          skipped = j;
        }
    };

    const int x0 = std::max(0, edges_.x[i] - kReach), count = edges_.x[i] + kReach + 1 - x0;
    const int y0 = std::max(0, edges_.y[i] - kReach), y1 = std::min(edges_.rows - 1, edges_.y[i] + kReach);
    for (int y = y0; y <= y1; ++y)
      for (uint32_t left = starts_.pixels.run(x0, y, count); left; left &= left - 1)
        consider(starts_.points[size_t(starts_.pixels.point(x0 + lowestBit(left), y))]);

    if (from < 0) return;
    if (from != i) links_.unlink(from, i);
    if (to != skipped) links_.unlink(skipped, to);
    links_.link(from, to, best);
  }

  // Whether the start j can continue the end i at all, their neighbours left alone.
  bool roughlyAhead(int i, int j) const {
    const EdgePoint &p = edges_.points[i], &q = edges_.points[j];
    const Eigen::Vector2f d = q.uv - p.uv;
    const float ahead = p.normal.x() * d.y() - p.normal.y() * d.x();
    return j != i && ahead > -2.5f && p.normal.dot(q.normal) > 0;
  }

  // Does b lie ahead of a, aside by less than a gap of this length excuses?
  bool inLine(int a, int b) const {
    const EdgePoint &p = edges_.points[a], &q = edges_.points[b];
    const Eigen::Vector2f d = q.uv - p.uv;
    const float aside = 0.5f * (std::fabs(p.normal.dot(d)) + std::fabs(q.normal.dot(d)));
    return aside < 0.4f + 0.12f * d.norm();
  }

  const EdgeMap& edges_;
  EdgeLinks& links_;
  LooseStarts& starts_;
};

}  // namespace

void bridgeGaps(const EdgeMap& edges, LooseStarts* starts, EdgeLinks* links) {
  Bridges(edges, starts, links).build();
}

}  // namespace monocular_eye_hand
