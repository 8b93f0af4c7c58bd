#include "recognition/resolved_contour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace monocular_eye_hand {
namespace {

constexpr double kOneLine = 2.5;             // lines nearer than this are one in the image [px]
constexpr double kBeside = 3.0;              // a sample stands for so much of its line to either side [px]
constexpr double kMinNeighbourCosine = 0.9;  // ... when they run the same way: |cos| of the angle between
constexpr double kCrowd = 10;                // within this of a ring other lines crowd it [px]
constexpr double kOutline = 10;              // strength of a silhouette: above any dihedral [rad]

double strength(const ObjectModel& model, const SeenSample& s) {
  return s.silhouette ? kOutline : dihedralOf(model, s.feature);
}

// How far one sample lies from another along that one's line and across it [px].
struct Offset {
  double along, across;
};
// Nothing between samples of one feature, and of lines that run in other directions.
std::optional<Offset> offsetOfParallels(const SeenSample& from, const SeenSample& to) {
  if (from.feature == to.feature || std::abs(from.direction.dot(to.direction)) < kMinNeighbourCosine)
    return std::nullopt;
  const Eigen::Vector2d apart = to.uv - from.uv;
  return Offset{from.direction.dot(apart), from.normal().dot(apart)};
}

// Samples in the order of their features: the most telling first.
std::vector<int> byStrength(const ObjectModel& model, const std::vector<SeenSample>& contour) {
  struct Run {
    int begin, end;
    double strength;
  };
  std::vector<Run> runs;
  for (int i = 0; i < int(contour.size()); ++i) {
    const SeenSample& s = contour[size_t(i)];
    const bool goes_on = i > 0 && contour[size_t(i) - 1].feature == s.feature &&
                         contour[size_t(i) - 1].silhouette == s.silhouette;
    if (!goes_on) runs.push_back({i, i, strength(model, s)});
    runs.back().end = i + 1;
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Run& a, const Run& b) { return a.strength > b.strength; });

  std::vector<int> order;
  for (const Run& run : runs)
    for (int i = run.begin; i < run.end; ++i) order.push_back(i);
  return order;
}

// Samples found by the cell of kBeside px that they lie in. Cells share chains, which costs a comparison now
// and then and makes the table small, whatever the image's size.
class SampleGrid {
 public:
  explicit SampleGrid(const std::vector<SeenSample>& contour)
      : contour_(contour), first_(kChains, -1), next_(contour.size(), -1) {}

  void add(int i) {
    const Eigen::Vector2i cell = cellOf(i);
    int& first = first_[chain(cell.x(), cell.y())];
    next_[size_t(i)] = first;
    first = i;
  }

  // Whether meets(offset) holds for a parallel sample not much farther than so many pixels.
  template <class Meets>
  bool anyParallel(int i, double within, const Meets& meets) const {
    const Eigen::Vector2i cell = cellOf(i);
    const int reach = int(std::ceil(within / kBeside));
    for (int dv = -reach; dv <= reach; ++dv)
      for (int du = -reach; du <= reach; ++du)
        for (int k = first_[chain(cell.x() + du, cell.y() + dv)]; k >= 0; k = next_[size_t(k)]) {
          const std::optional<Offset> offset = offsetOfParallels(contour_[size_t(k)], contour_[size_t(i)]);
          if (offset && meets(*offset)) return true;
        }
    return false;
  }

 private:
  static constexpr uint32_t kChains = 1024;  // a power of two
  static size_t chain(int u, int v) {
    return (uint32_t(u) * 73856093u ^ uint32_t(v) * 19349663u) & (kChains - 1);
  }
  Eigen::Vector2i cellOf(int i) const {
    const Eigen::Vector2d& uv = contour_[size_t(i)].uv;
    return {int(std::floor(uv.x() / kBeside)), int(std::floor(uv.y() / kBeside))};
  }

  const std::vector<SeenSample>& contour_;
  std::vector<int> first_, next_;
};

bool isOneLine(const Offset& offset) {
  return std::abs(offset.across) < kOneLine && std::abs(offset.along) < kBeside;
}

// The nearest and the farthest line on one side.
struct LinesBeside {
  double nearest = kCrowd, farthest = 0;  // [px]

  void add(double distance) {
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  bool areTwo() const { return farthest - nearest >= kOneLine; }
};

bool isCircle(const ObjectModel& model, int feature) {
  const int circle = feature - int(model.edges.size());
  return circle >= 0 && circle < int(model.circles.size());
}

}  // namespace

double dihedralOf(const ObjectModel& model, int feature) {
  const int edges = int(model.edges.size()), circles = int(model.circles.size());
  if (feature < edges) return model.edges[size_t(feature)].dihedral;
  if (feature < edges + circles) return model.circles[size_t(feature - edges)].dihedral;
  return 0;
}

std::vector<size_t> resolvedSamples(const ObjectModel& model, const std::vector<SeenSample>& contour) {
  SampleGrid kept(contour);
  std::vector<size_t> resolved;
  for (int i : byStrength(model, contour)) {
    if (kept.anyParallel(i, kBeside, isOneLine)) continue;
    kept.add(i);
    resolved.push_back(size_t(i));
  }
  std::sort(resolved.begin(), resolved.end());
  return resolved;
}

std::vector<SeenSample> resolvedContour(const ObjectModel& model, const std::vector<SeenSample>& contour) {
  std::vector<SeenSample> resolved;
  for (size_t i : resolvedSamples(model, contour)) resolved.push_back(contour[i]);
  return resolved;
}

std::vector<char> crowdedRings(const ObjectModel& model, const std::vector<SeenSample>& contour) {
  std::vector<char> flags(contour.size(), 0);
  if (model.circles.empty()) return flags;

  SampleGrid all(contour);
  for (size_t i = 0; i < contour.size(); ++i) all.add(int(i));

  const auto isCrowded = [&](int i) {
    LinesBeside left, right;
    return all.anyParallel(i, kCrowd, [&](const Offset& offset) {
      const double distance = std::abs(offset.across);
      if (std::abs(offset.along) < kBeside && distance < kCrowd)
        (offset.across < 0 ? left : right).add(distance);
      return left.areTwo() && right.areTwo();
    });
  };
  for (size_t i = 0; i < contour.size(); ++i)
    flags[i] = isCircle(model, contour[i].feature) && isCrowded(int(i));
  return flags;
}

}  // namespace monocular_eye_hand
