#include "features/linking.h"

#include <algorithm>
#include <cmath>

#include "features/edge_links.h"

namespace monocular_eye_hand {
namespace {

// A trace is kept when noise alone would make fewer than one as strong: each independent point exceeds
// gradient g with probability exp(-g^2 / (2 noise^2)); the number of possible traces is about (pixels)^2.
class NoiseTest {
 public:
  NoiseTest(const EdgeMap& edges)
      : scale_(float(0.5 / (edges.gradient_noise * edges.gradient_noise * edges.correlation_length))),
        needed_(float(2 * std::log(double(edges.rows) * edges.cols))) {}
  void add(float gradient) { evidence_ += std::min(scale_ * gradient * gradient, kMaxEvidence); }
  bool passed() const { return evidence_ >= needed_; }

 private:
  static constexpr float kMaxEvidence = 6;  // so that a few strong points do not carry a weak trace
  float scale_, needed_, evidence_ = 0;
};

}  // namespace

class EdgeLinker::Linking {
 public:
  explicit Linking(int min_trace_points) : min_trace_points_(min_trace_points) {}

  void run(const EdgeMap& edges, LinkedEdges* out) {
    links_.reset(edges.points.size());
    linkMutualChoices(edges, &choices_, &links_);
    linkByClaims(edges, choices_, &links_);
    bridgeGaps(edges, &starts_, &links_);
    out->points.clear();
    out->points.reserve(edges.points.size());
    out->traces.clear();
    used_.assign(edges.points.size(), 0);
    const int n = int(edges.points.size());
    for (int i = 0; i < n; ++i)
      if (links_.previous[i] < 0) append(edges, i, false, out);
    for (int i = 0; i < n; ++i)
      if (!used_[i]) append(edges, i, true, out);
  }

 private:
  void append(const EdgeMap& edges, int start, bool closed, LinkedEdges* out) {
    EdgeTrace trace;
    trace.first = int(out->points.size());
    trace.closed = closed;
    NoiseTest test(edges);
    for (int i = start; i >= 0 && !used_[i]; i = links_.next[i]) {
      used_[i] = 1;
      out->points.push_back(edges.points[i]);
      test.add(edges.points[i].gradient);
    }
    trace.count = int(out->points.size()) - trace.first;
    if (trace.count >= min_trace_points_ && test.passed())
      out->traces.push_back(trace);
    else
      out->points.resize(trace.first);
  }

  const int min_trace_points_;
  EdgeLinks links_;
  std::vector<Choices> choices_;
  LooseStarts starts_;
  std::vector<char> used_;  // per edge point
};

EdgeLinker::EdgeLinker(const FeatureOptions& options)
    : linking_(std::make_unique<Linking>(options.min_trace_points)) {}
EdgeLinker::~EdgeLinker() = default;
void EdgeLinker::link(const EdgeMap& edges, LinkedEdges* out) { linking_->run(edges, out); }

}  // namespace monocular_eye_hand
