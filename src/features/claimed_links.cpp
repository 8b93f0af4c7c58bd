#include <array>

#include "features/edge_links.h"
#include "features/pixel_rings.h"

namespace monocular_eye_hand {
namespace {

// The neighbours of a point that continue it or that it continues, ring by ring.
class Neighbours {
 public:
  Neighbours(const EdgeMap& edges, int i) : edges_(edges), i_(i), rings_(edges, i) {}
  struct One {
    int point;
    PairLink pair;
  };
  /// Calls use(neighbour) for those on a ring; rings have to be asked for from within.
  template <class Use>
  void onRing(int reach, const Use& use) {
    if (seen_ < reach) look(reach);
    for (int k = end_[reach - 1]; k < end_[reach]; ++k) use(all_[size_t(k)]);
  }

 private:
  void look(int reach) {
    int n = end_[reach - 1];
    rings_.onRing(reach, [&](int j) {
      const PairLink pair = linkOf(edges_.points[i_], edges_.points[j]);
      if (pair.order) all_[size_t(n++)] = {j, pair};
    });
    end_[reach] = n;
    seen_ = reach;
  }
  const EdgeMap& edges_;
  const int i_;
  const PixelRings rings_;
  std::array<One, 8 + 16> all_;
  int end_[3] = {0, 0, 0};  // of ring r: all_[end_[r - 1] .. end_[r])
  int seen_ = 0;
};

// Links point i with the best successor (order 1) or predecessor (-1) that is free or held by a dearer link.
void claim(int i, int order, Neighbours* neighbours, EdgeLinks* links) {
  int best = -1;
  float best_cost = EdgeLinks::kNone;
  for (int reach = 1; reach <= 2 && best < 0; ++reach)
    neighbours->onRing(reach, [&](const Neighbours::One& one) {
      if (one.pair.order != order || one.pair.cost >= best_cost) return;
      const int j = one.point;
      const int rival = order > 0 ? links->previous[j] : (links->next[j] >= 0 ? j : -1);
      if (rival >= 0 && links->cost[rival] <= one.pair.cost) return;
      best = j;
      best_cost = one.pair.cost;
    });
  if (best < 0) return;
  const int from = order > 0 ? i : best, to = order > 0 ? best : i;
  if (order > 0 && links->previous[to] >= 0) links->unlink(links->previous[to], to);
  if (order < 0 && links->next[from] >= 0) links->unlink(from, links->next[from]);
  links->link(from, to, best_cost);
}

}  // namespace

void linkByClaims(const EdgeMap& edges, const std::vector<Choices>& choices, EdgeLinks* links) {
  const int n = int(edges.points.size());
  for (int i = 0; i < n; ++i) {
    const bool ahead = links->next[i] < 0 && choices[i].ahead.made(),
               behind = links->previous[i] < 0 && choices[i].behind.made();
    if (!ahead && !behind) continue;
    Neighbours neighbours(edges, i);
    if (ahead) claim(i, 1, &neighbours, links);
    if (behind) claim(i, -1, &neighbours, links);
  }
}

}  // namespace monocular_eye_hand
