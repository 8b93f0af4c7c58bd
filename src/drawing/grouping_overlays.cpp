#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "monocular_eye_hand/drawing/overlays.h"

namespace monocular_eye_hand {
namespace {

constexpr double kGroupingDim = 0.5;

template <typename List>
bool inside(int index, const List& list) {
  return index >= 0 && index < int(list.size());
}

bool linksLines(GroupingKind kind) {
  return kind == GroupingKind::kJunction || kind == GroupingKind::kTriplet || kind == GroupingKind::kChain ||
         kind == GroupingKind::kQuad;
}

// Which connected group each segment belongs to.
std::vector<int> connectedGroups(size_t segments, const std::vector<Grouping>& groupings, double min_weight) {
  std::vector<int> parent(segments);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  for (const Grouping& grouping : groupings) {
    if (!linksLines(grouping.kind) || grouping.weight < min_weight) continue;
    for (int segment : grouping.segments)
      if (inside(segment, parent) && inside(grouping.segments[0], parent))
        parent[root(segment)] = root(grouping.segments[0]);
  }
  for (size_t k = 0; k < segments; ++k) parent[k] = root(int(k));
  return parent;
}

}  // namespace

void drawGrouping(Canvas* canvas, const FeatureSet& features, const Grouping& grouping,
                  const Colour& colour) {
  for (int k : grouping.segments)
    if (inside(k, features.segments)) canvas->line(features.segments[k].p, features.segments[k].q, colour, 2);
  for (int k : grouping.ellipses)
    if (inside(k, features.ellipses)) canvas->ellipse(features.ellipses[k].ellipse, colour, 2);
  for (const Eigen::Vector2d& p : grouping.points) canvas->dot(p, 3, colour);
}

std::vector<GroupingPicture> groupingPictures(const cv::Mat& grey, const FeatureSet& features,
                                              const std::vector<Grouping>& groupings, int max_lines) {
  std::map<GroupingKind, std::vector<const Grouping*>> by_kind;
  for (const Grouping& grouping : groupings) by_kind[grouping.kind].push_back(&grouping);
  std::vector<GroupingPicture> pictures;
  for (auto& [kind, members] : by_kind) {
    std::stable_sort(members.begin(), members.end(),
                     [](const Grouping* a, const Grouping* b) { return a->weight > b->weight; });
    const int shown = std::min(std::max(max_lines, 0), int(members.size()));
    Canvas canvas(grey, features.camera, kGroupingDim);
    // The best ones last: on top.
    for (int k = shown - 1; k >= 0; --k) drawGrouping(&canvas, features, *members[k], paletteColour(k));
    canvas.caption(fmt::format("{}: {} of {}", toString(kind), shown, members.size()));
    pictures.push_back({kind, shown, int(members.size()), canvas.picture()});
  }
  return pictures;
}

cv::Mat lineGroupsPicture(const cv::Mat& grey, const FeatureSet& features,
                          const std::vector<Grouping>& groupings, double min_weight) {
  Canvas canvas(grey, features.camera, kGroupingDim);
  const std::vector<int> group = connectedGroups(features.segments.size(), groupings, min_weight);
  std::map<int, int> size, colour;
  for (int g : group) size[g]++;
  for (size_t k = 0; k < group.size(); ++k) {
    const LineSegment& segment = features.segments[k];
    if (size[group[k]] == 1) {
      canvas.line(segment.p, segment.q, {100, 100, 100}, 1);
      continue;
    }
    const auto found = colour.emplace(group[k], int(colour.size())).first;
    canvas.line(segment.p, segment.q, paletteColour(found->second), 2);
  }
  return canvas.picture();
}

}  // namespace monocular_eye_hand
