#include "recognition/resolved_contour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace monocular_eye_hand {
namespace {

constexpr double kOneLine = 2.5;   // lines nearer than this are one in the image [px]
constexpr double kBeside = 3.0;    // a sample stands for so much of its line to either side [px]
constexpr double kParallel = 0.9;  // ... when they run the same way: |cos| of the angle between
constexpr double kOutline = 10;    // strength of a silhouette: above any dihedral [rad]

double strength(const ObjectModel& model, const SeenSample& s) {
  if (s.silhouette) return kOutline;
  const int edges = int(model.edges.size()), circles = int(model.circles.size());
  if (s.group < edges) return model.edges[size_t(s.group)].dihedral;
  if (s.group < edges + circles) return model.circles[size_t(s.group - edges)].dihedral;
  return 0;
}

bool sameLine(const SeenSample& a, const SeenSample& b) {
  if (a.group == b.group || std::abs(a.direction.dot(b.direction)) < kParallel) return false;
  const Eigen::Vector2d apart = b.uv - a.uv;
  const double along = a.direction.dot(apart);
  const double across = a.direction.x() * apart.y() - a.direction.y() * apart.x();
  return std::abs(across) < kOneLine && std::abs(along) < kBeside;
}

// The samples that are kept, found by the cell of kBeside px that they lie in. Cells share chains, which
// costs a comparison now and then and makes the table small, whatever the image's size.
class KeptSamples {
 public:
  explicit KeptSamples(const std::vector<SeenSample>& contour)
      : contour_(contour), first_(kChains, -1), next_(contour.size(), -1) {}

  void add(int i) {
    int& first = first_[chain(contour_[size_t(i)].uv, 0, 0)];
    next_[size_t(i)] = first;
    first = i;
  }

  bool hold(const SeenSample& s) const {
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du)
        for (int i = first_[chain(s.uv, du, dv)]; i >= 0; i = next_[size_t(i)])
          if (sameLine(contour_[size_t(i)], s)) return true;
    return false;
  }

 private:
  static constexpr uint32_t kChains = 4096;  // a power of two
  static size_t chain(const Eigen::Vector2d& uv, int du, int dv) {
    const uint32_t u = uint32_t(int(std::floor(uv.x() / kBeside)) + du);
    const uint32_t v = uint32_t(int(std::floor(uv.y() / kBeside)) + dv);
    return (u * 73856093u ^ v * 19349663u) & (kChains - 1);
  }

  const std::vector<SeenSample>& contour_;
  std::vector<int> first_, next_;
};

}  // namespace

std::vector<SeenSample> resolvedContour(const ObjectModel& model, const std::vector<SeenSample>& contour) {
  std::vector<double> strengths;
  for (const SeenSample& s : contour) strengths.push_back(strength(model, s));
  std::vector<int> order(contour.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return strengths[size_t(a)] > strengths[size_t(b)]; });

  KeptSamples kept(contour);
  std::vector<char> keep(contour.size(), 0);
  for (int i : order) {
    if (kept.hold(contour[size_t(i)])) continue;
    kept.add(i);
    keep[size_t(i)] = 1;
  }

  std::vector<SeenSample> resolved;
  for (size_t i = 0; i < contour.size(); ++i)
    if (keep[i]) resolved.push_back(contour[i]);
  return resolved;
}

}  // namespace monocular_eye_hand
