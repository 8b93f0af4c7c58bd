#include "edge_links.h"
#include "pixel_rings.h"

namespace monocular_eye_hand {
namespace {

// The cheapest neighbour of a point on one side.
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

// Each pair of neighbours is looked at once, from the later point in raster order.
void chooseOnInnerRing(const EdgeMap& edges, std::vector<Choices>* choices) {
  const int n = int(edges.points.size());
  for (int i = 0; i < n; ++i) {
    const int x = edges.x[i], y = edges.y[i];
    const auto consider = [&](int j) {
      const PairLink pair = linkOf(edges.points[i], edges.points[j]);
      (*choices)[i].consider(j, pair);
      (*choices)[j].consider(i, {-pair.order, pair.cost});
    };
    if (const uint32_t above = edges.pixels.run(x - 1, y - 1, 3)) {
      const int first = edges.pixels.point(x - 1 + lowestBit(above), y - 1);
      const int count = int((above & 1) + (above >> 1 & 1) + (above >> 2));
      for (int j = first; j < first + count; ++j) consider(j);
    }
    if (edges.pixels.run(x - 1, y, 1)) consider(i - 1);
  }
}

// For points that found none ahead or behind.
void chooseOnOuterRing(const EdgeMap& edges, std::vector<Choices>* choices) {
  const int n = int(edges.points.size());
  for (int i = 0; i < n; ++i) {
    Choices& own = (*choices)[i];
    if (own.ahead.point >= 0 && own.behind.point >= 0) continue;
    Choices farther;
    PixelRings(edges, i).onRing(
        2, [&](int j) { farther.consider(j, linkOf(edges.points[i], edges.points[j])); });
    if (own.ahead.point < 0) own.ahead = farther.ahead;
    if (own.behind.point < 0) own.behind = farther.behind;
  }
}

}  // namespace

std::vector<char> linkMutualChoices(const EdgeMap& edges, EdgeLinks* links) {
  const int n = int(edges.points.size());
  std::vector<Choices> choices(edges.points.size());
  chooseOnInnerRing(edges, &choices);
  chooseOnOuterRing(edges, &choices);
  std::vector<char> found(edges.points.size());
  for (int i = 0; i < n; ++i) {
    const Choice& ahead = choices[i].ahead;
    found[i] = char((ahead.point >= 0 ? 1 : 0) | (choices[i].behind.point >= 0 ? 2 : 0));
    if (ahead.point >= 0 && choices[ahead.point].behind.point == i) links->link(i, ahead.point, ahead.cost);
  }
  return found;
}

}  // namespace monocular_eye_hand
