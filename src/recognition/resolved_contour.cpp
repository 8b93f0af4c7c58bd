#include "recognition/resolved_contour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace monocular_eye_hand {
namespace {

constexpr double kOneLine = 2.5;   // lines nearer than this are one in the image [px]
constexpr double kBeside = 3.0;    // a sample stands for so much of its line to either side [px]
constexpr double kParallel = 0.9;  // ... when they run the same way: |cos| of the angle between
constexpr double kOutline = 10;    // strength of a silhouette: above any dihedral [rad]

double strength(const ObjectModel& model, const SeenSample& s) {
  return s.silhouette ? kOutline : dihedralOf(model, s.group);
}

bool sameLine(const SeenSample& a, const SeenSample& b) {
  if (a.group == b.group || std::abs(a.direction.dot(b.direction)) < kParallel) return false;
  const Eigen::Vector2d apart = b.uv - a.uv;
  const double along = a.direction.dot(apart);
  const double across = a.direction.x() * apart.y() - a.direction.y() * apart.x();
  return std::abs(across) < kOneLine && std::abs(along) < kBeside;
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
    const bool goes_on =
        i > 0 && contour[size_t(i) - 1].group == s.group && contour[size_t(i) - 1].silhouette == s.silhouette;
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

// The samples that are kept, found by the cell of kBeside px that they lie in. Cells share chains, which
// costs a comparison now and then and makes the table small, whatever the image's size.
class KeptSamples {
 public:
  explicit KeptSamples(const std::vector<SeenSample>& contour)
      : contour_(contour), first_(kChains, -1), next_(contour.size(), -1) {}

  // Keeps a sample unless a kept one is the same line.
  bool keep(int i) {
    const SeenSample& s = contour_[size_t(i)];
    const int u = int(std::floor(s.uv.x() / kBeside)), v = int(std::floor(s.uv.y() / kBeside));
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du)
        for (int k = first_[chain(u + du, v + dv)]; k >= 0; k = next_[size_t(k)])
          if (sameLine(contour_[size_t(k)], s)) return false;

    int& first = first_[chain(u, v)];
    next_[size_t(i)] = first;
    first = i;
    return true;
  }

 private:
  static constexpr uint32_t kChains = 1024;  // a power of two
  static size_t chain(int u, int v) {
    return (uint32_t(u) * 73856093u ^ uint32_t(v) * 19349663u) & (kChains - 1);
  }

  const std::vector<SeenSample>& contour_;
  std::vector<int> first_, next_;
};

}  // namespace

double dihedralOf(const ObjectModel& model, int group) {
  const int edges = int(model.edges.size()), circles = int(model.circles.size());
  if (group < edges) return model.edges[size_t(group)].dihedral;
  if (group < edges + circles) return model.circles[size_t(group - edges)].dihedral;
  return 0;
}

std::vector<size_t> resolvedSamples(const ObjectModel& model, const std::vector<SeenSample>& contour) {
  KeptSamples kept(contour);
  std::vector<size_t> resolved;
  for (int i : byStrength(model, contour))
    if (kept.keep(i)) resolved.push_back(size_t(i));
  std::sort(resolved.begin(), resolved.end());
  return resolved;
}

std::vector<SeenSample> resolvedContour(const ObjectModel& model, const std::vector<SeenSample>& contour) {
  std::vector<SeenSample> resolved;
  for (size_t i : resolvedSamples(model, contour)) resolved.push_back(contour[i]);
  return resolved;
}

}  // namespace monocular_eye_hand
