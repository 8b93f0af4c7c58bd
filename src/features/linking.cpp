#include "monocular_eye_hand/features/linking.h"

#include <algorithm>
#include <cmath>

#include "edge_links.h"

namespace monocular_eye_hand {
namespace {

// A trace is kept when noise alone would make fewer than one as strong: each independent point exceeds
// gradient g with probability exp(-g^2 / (2 noise^2)); the number of possible traces is about (pixels)^2.
class NoiseTest {
 public:
  NoiseTest(const EdgeMap& edges)
      : scale_(float(0.5 / (edges.gradient_noise * edges.gradient_noise * edges.correlation_length))),
        needed_(float(2 * std::log(double(edges.rows) * edges.cols))) {}
  void add(float gradient) { evidence_ += std::min(scale_ * gradient * gradient, kMost); }
  bool passed() const { return evidence_ >= needed_; }

 private:
  static constexpr float kMost = 6;  // so that a few strong points do not carry a weak trace
  float scale_, needed_, evidence_ = 0;
};

void append(const EdgeMap& edges, const std::vector<int>& next, int start, bool closed, int min_points,
            std::vector<char>* used, LinkedEdges* out) {
  EdgeTrace trace;
  trace.first = int(out->points.size());
  trace.closed = closed;
  NoiseTest test(edges);
  for (int i = start; i >= 0 && !(*used)[i]; i = next[i]) {
    (*used)[i] = 1;
    out->points.push_back(edges.points[i]);
    test.add(edges.points[i].gradient);
  }
  trace.count = int(out->points.size()) - trace.first;
  if (trace.count >= min_points && test.passed())
    out->traces.push_back(trace);
  else
    out->points.resize(trace.first);
}

}  // namespace

LinkedEdges linkEdges(const EdgeMap& edges, const FeatureOptions& options) {
  EdgeLinks links(edges.points.size());
  linkByClaims(edges, linkMutualChoices(edges, &links), &links);
  bridgeGaps(edges, &links);
  LinkedEdges out;
  out.points.reserve(edges.points.size());
  std::vector<char> used(edges.points.size(), 0);
  const int n = int(edges.points.size()), least = options.min_trace_points;
  for (int i = 0; i < n; ++i)
    if (links.previous[i] < 0) append(edges, links.next, i, false, least, &used, &out);
  for (int i = 0; i < n; ++i)
    if (!used[i]) append(edges, links.next, i, true, least, &used, &out);
  return out;
}

}  // namespace monocular_eye_hand
