#include "features/edge_links.h"
#include "features/pixel_rings.h"

namespace monocular_eye_hand {
namespace {

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
    if (own.ahead.made() && own.behind.made()) continue;
    Choices farther;
    PixelRings(edges, i).onRing(
        2, [&](int j) { farther.consider(j, linkOf(edges.points[i], edges.points[j])); });
    if (!own.ahead.made()) own.ahead = farther.ahead;
    if (!own.behind.made()) own.behind = farther.behind;
  }
}

}  // namespace

void linkMutualChoices(const EdgeMap& edges, std::vector<Choices>* choices, EdgeLinks* links) {
  choices->assign(edges.points.size(), {});
  chooseOnInnerRing(edges, choices);
  chooseOnOuterRing(edges, choices);
  for (int i = 0; i < int(edges.points.size()); ++i) {
    const Choice& ahead = (*choices)[i].ahead;
    if (!ahead.made()) continue;
    const Choice& behind = (*choices)[ahead.point()].behind;
    if (behind.made() && behind.point() == i) links->link(i, ahead.point(), ahead.cost());
  }
}

}  // namespace monocular_eye_hand
