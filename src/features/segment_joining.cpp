#include <algorithm>
#include <cmath>
#include <numeric>

#include "features/collinear_pairs.h"
#include "features/joining.h"

namespace monocular_eye_hand {

class SegmentJoiner::Joining {
 public:
  explicit Joining(const FeatureOptions& options) : options_(options), pairs_(options) {}

  void run(std::vector<LineSegment>* segments, std::vector<int>* joined_pieces) {
    joined_pieces->clear();
    if (options_.join_gap_ratio <= 0) return;
    segments_ = segments;
    const size_t plain = segments->size();
    parent_.resize(plain);
    std::iota(parent_.begin(), parent_.end(), 0);
    next_.assign(plain, -1);
    last_ = parent_;
    for (const CollinearPairs::Pair& pair : pairs_.find(*segments)) tryJoin(pair);
    for (int i = 0; i < int(plain); ++i)
      if (parent_[i] == i && next_[i] >= 0) add(i, joined_pieces);
  }

 private:
  int root(int i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  void tryJoin(const CollinearPairs::Pair& pair) {
    const int a = root(pair.a), b = root(pair.b);
    if (a == b) return;
    double gap;
    if (!collinear(stretchOf(a), stretchOf(b), options_, &gap)) return;
    const int keep = std::min(a, b), drop = std::max(a, b);
    parent_[drop] = keep;
    next_[last_[keep]] = drop;
    last_[keep] = last_[drop];
  }
  Stretch stretchOf(int root) const { return Stretch(next_[root] >= 0 ? joined(root) : (*segments_)[root]); }

  // Weighted line through the pieces, each standing for its middle and ends with its own uncertainty.
  LineSegment joined(int first) const {
    const std::vector<LineSegment>& plain = *segments_;
    double w = 0, xx = 0, xy = 0, yy = 0;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    int longest = first;
    for (int i = first; i >= 0; i = next_[i]) {
      const LineSegment& s = plain[i];
      const double wi = 1 / (s.sigma_offset * s.sigma_offset);
      w += wi;
      mean += wi * 0.5 * (s.p + s.q);
      if (s.length() > plain[longest].length()) longest = i;
    }
    mean /= w;

    for (int i = first; i >= 0; i = next_[i]) {
      const LineSegment& s = plain[i];
      const double wi = 1 / (s.sigma_offset * s.sigma_offset);
      const Eigen::Vector2d c = 0.5 * (s.p + s.q) - mean, h = 0.5 * (s.q - s.p);
      // Second moments of a piece of even density about its own middle: a third of the half length squared.
      xx += wi * (c.x() * c.x() + h.x() * h.x() / 3);
      xy += wi * (c.x() * c.y() + h.x() * h.y() / 3);
      yy += wi * (c.y() * c.y() + h.y() * h.y() / 3);
    }
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    Eigen::Vector2d d(std::cos(angle), std::sin(angle));
    const LineSegment& main = plain[longest];
    if (d.dot(main.direction()) < 0) d = -d;

    LineSegment out = main;
    constexpr double kFar = 1e18;  // px: beyond every place
    double low = kFar, high = -kFar, contrast = 0, length = 0;
    for (int i = first; i >= 0; i = next_[i]) {
      const LineSegment& s = plain[i];
      for (int end = 0; end < 2; ++end) {
        const double t = d.dot((end == 0 ? s.p : s.q) - mean), sigma = end == 0 ? s.sigma_p : s.sigma_q;
        if (t < low) {
          low = t;
          out.sigma_p = sigma;
        }
        if (t > high) {
          high = t;
          out.sigma_q = sigma;
        }
      }
      contrast += s.contrast * s.length();
      length += s.length();
    }

    out.p = mean + low * d;
    out.q = mean + high * d;
    const double spread = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
    out.sigma_angle = 1 / std::sqrt(std::max(spread, 1e-9));
    out.sigma_offset = std::sqrt(1 / w + std::pow(out.sigma_angle * 0.5 * (low + high), 2));
    out.contrast = contrast / length;
    out.trace = -1;
    return out;
  }

  void add(int root, std::vector<int>* joined_pieces) {
    LineSegment whole = joined(root);
    whole.first_piece = int(joined_pieces->size());
    for (int i = root; i >= 0; i = next_[i]) joined_pieces->push_back(i);
    whole.piece_count = int(joined_pieces->size()) - whole.first_piece;
    // In order along it.
    const Eigen::Vector2d d = whole.direction();
    std::sort(joined_pieces->begin() + whole.first_piece, joined_pieces->end(), [&](int i, int j) {
      return d.dot((*segments_)[i].p + (*segments_)[i].q) < d.dot((*segments_)[j].p + (*segments_)[j].q);
    });
    segments_->push_back(whole);
  }

  const FeatureOptions options_;
  CollinearPairs pairs_;
  std::vector<LineSegment>* segments_ = nullptr;  // plain ones first
  // Of plain segments: those joined so far form trees, and lists from their root on.
  std::vector<int> parent_;  // a root's is itself
  std::vector<int> next_;    // -1: none
  std::vector<int> last_;    // of a root's list
};

SegmentJoiner::SegmentJoiner(const FeatureOptions& options) : joining_(std::make_unique<Joining>(options)) {}
SegmentJoiner::~SegmentJoiner() = default;
void SegmentJoiner::join(std::vector<LineSegment>* segments, std::vector<int>* joined_pieces) {
  joining_->run(segments, joined_pieces);
}

}  // namespace monocular_eye_hand
