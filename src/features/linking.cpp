#include "monocular_eye_hand/features/linking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <opencv2/core/hal/intrin.hpp>

namespace monocular_eye_hand {
namespace {

constexpr float kNoLink = 1e9f;

int lowestBit(uint32_t v) {  // de Bruijn multiplication
  static constexpr int8_t kPlace[32] = {0,  1,  28, 2,  29, 14, 24, 3, 30, 22, 20, 15, 25, 17, 4,  8,
                                        31, 27, 13, 23, 21, 19, 16, 7, 26, 12, 18, 6,  11, 5,  10, 9};
  return kPlace[((v & (~v + 1)) * 0x077CB531u) >> 27];
}

// Chains edge points; every point has at most one successor and one predecessor.
class Linker {
 public:
  explicit Linker(const EdgeMap& edges)
      : edges_(edges),
        next_(edges.points.size(), -1),
        previous_(edges.points.size(), -1),
        next_cost_(edges.points.size(), kNoLink) {}

  void link() {
    linkMutual();
    const int n = int(edges_.points.size());
    for (int i = 0; i < n; ++i) {  // points whose choice chose another
      const bool ahead = next_[i] < 0 && ahead_[i] >= 0, behind = previous_[i] < 0 && behind_[i] >= 0;
      if (!ahead && !behind) continue;
      const Window window(edges_, i);
      Neighbours found;
      if (ahead) seek(i, 1, window, &found);
      if (behind) seek(i, -1, window, &found);
    }
    findLooseStarts();
    for (int i = 0; i < n; ++i)
      if (looseEnd(i)) bridge(i);
  }
  const std::vector<int>& next() const { return next_; }
  const std::vector<int>& previous() const { return previous_; }

 private:
  // Cost of b as successor of a: distance plus departure from both tangents; kNoLink when b does not continue
  // a. The cost of a as predecessor of b is the same.
  float cost(int a, int b) const {
    const EdgePoint &p = edges_.points[a], &q = edges_.points[b];
    const float dx = q.uv.x() - p.uv.x(), dy = q.uv.y() - p.uv.y();
    const float forward_a = -p.normal.y() * dx + p.normal.x() * dy;
    const float forward_b = -q.normal.y() * dx + q.normal.x() * dy;
    if (forward_a < 0.2f || forward_b < 0.2f || p.normal.dot(q.normal) < 0.3f) return kNoLink;
    const float aside =
        std::fabs(p.normal.x() * dx + p.normal.y() * dy) + std::fabs(q.normal.x() * dx + q.normal.y() * dy);
    return std::sqrt(dx * dx + dy * dy) + 1.5f * aside;
  }

  // The points on the rings of pixels one and two away from a point, in raster order.
  class Window {
   public:
    // Edge points keep two pixels from the border: the window lies in the image.
    Window(const EdgeMap& edges, int i) : edges_(edges), x_(edges.x[i] - 2), y_(edges.y[i] - 2) {
      for (int k = 0; k < 5; ++k) bits_ |= edges.pixels.run(x_, y_ + k, 5) << (5 * k);
    }
    /// Puts the points of a ring into `points`; returns how many.
    int ring(int reach, int32_t* points) const {
      // Five bits per row, the top row lowest.
      constexpr uint32_t kInner = (14u << 5) | (10u << 10) | (14u << 15);
      constexpr uint32_t kOuter = 31u | (17u << 5) | (17u << 10) | (17u << 15) | (31u << 20);
      int count = 0;
      for (uint32_t left = bits_ & (reach == 1 ? kInner : kOuter); left; left &= left - 1) {
        const int at = lowestBit(left), row = at / 5;
        points[count++] = edges_.pixels.point(x_ + at - 5 * row, y_ + row);
      }
      return count;
    }

   private:
    const EdgeMap& edges_;
    const int x_, y_;
    uint32_t bits_ = 0;
  };

  // Those of them that continue a point.
  struct Neighbours {
    struct One {
      int point, sign;
      float cost;
    };
    std::array<One, 8 + 16> ring;
    int end[3] = {0, 0, 0};  // of ring r: ring[end[r - 1] .. end[r])
    int reach = 0;           // rings looked at
  };
  void look(int i, int reach, const Window& window, Neighbours* found) const {
    if (found->reach >= reach) return;
    found->reach = reach;
    int32_t present[16];
    const int count = window.ring(reach, present);
    int n = found->end[reach - 1];
    for (int from = 0; from < count; from += kLanes) {
      const Costs costs = lookAtFour(i, present + from, std::min(kLanes, count - from));
      for (int k = 0; k < kLanes && from + k < count; ++k) {
        const bool after = costs.after[k] < kNoLink;
        const float cost = after ? costs.after[k] : costs.before[k];
        if (cost < kNoLink) found->ring[size_t(n++)] = {present[from + k], after ? 1 : -1, cost};
      }
    }
    found->end[reach] = n;
  }

  // Cost of linking a with up to four neighbours b that come after it, and of those before it, all at once.
  // The lanes past the count repeat the last neighbour.
  static constexpr int kLanes = 4;
  struct Costs {
    float after[kLanes], before[kLanes];
  };
  Costs lookAtFour(int a, const int32_t* b, int count) const {
    static_assert(offsetof(EdgePoint, uv) == 0 && offsetof(EdgePoint, normal) == 8, "loaded together below");
    using cv::v_float32x4;
    const auto load = [&](int i) { return cv::v_load(reinterpret_cast<const float*>(&edges_.points[i])); };
    const EdgePoint& p = edges_.points[a];
    const v_float32x4 nx = cv::v_setall_f32(p.normal.x()), ny = cv::v_setall_f32(p.normal.y());
    v_float32x4 qx, qy, mx, my;
    cv::v_transpose4x4(load(b[0]), load(b[std::min(1, count - 1)]), load(b[std::min(2, count - 1)]),
                       load(b[count - 1]), qx, qy, mx, my);
    const v_float32x4 dx = qx - cv::v_setall_f32(p.uv.x()), dy = qy - cv::v_setall_f32(p.uv.y());
    const v_float32x4 forward_a = nx * dy - ny * dx, forward_b = mx * dy - my * dx;
    const v_float32x4 least = cv::v_setall_f32(0.2f), most = cv::v_setall_f32(-0.2f);
    const v_float32x4 alike = nx * mx + ny * my >= cv::v_setall_f32(0.3f);
    const v_float32x4 aside = cv::v_abs(nx * dx + ny * dy) + cv::v_abs(mx * dx + my * dy);
    const v_float32x4 cost = cv::v_sqrt(dx * dx + dy * dy) + cv::v_setall_f32(1.5f) * aside;
    const v_float32x4 none = cv::v_setall_f32(kNoLink);
    Costs costs;
    cv::v_store(costs.after, cv::v_select((forward_a >= least) & (forward_b >= least) & alike, cost, none));
    cv::v_store(costs.before, cv::v_select((forward_a <= most) & (forward_b <= most) & alike, cost, none));
    return costs;
  }

  // Of every point the best neighbour ahead and behind, on the nearer ring if there is one. Two points that
  // choose each other are linked: neither will find a better one.
  void linkMutual() {
    const int n = int(edges_.points.size());
    ahead_.resize(size_t(n));
    behind_.resize(size_t(n));
    std::vector<float> costs(static_cast<size_t>(n));
    for (int i = 0; i < n; ++i) {
      const Window window(edges_, i);
      Choice ahead, behind;
      choose(i, window, 1, &ahead, &behind);
      if (ahead.point < 0 || behind.point < 0) {
        Choice farther_ahead, farther_behind;
        choose(i, window, 2, &farther_ahead, &farther_behind);
        if (ahead.point < 0) ahead = farther_ahead;
        if (behind.point < 0) behind = farther_behind;
      }
      ahead_[i] = ahead.point;
      behind_[i] = behind.point;
      costs[i] = ahead.cost;
    }
    for (int i = 0; i < n; ++i) {
      const int j = ahead_[i];
      if (j < 0 || behind_[j] != i) continue;
      next_[i] = j;
      previous_[j] = i;
      next_cost_[i] = costs[i];
    }
  }
  struct Choice {
    int point = -1;
    float cost = kNoLink;
    void consider(int candidate, float candidate_cost) {
      const bool better = candidate_cost < cost;
      point = better ? candidate : point;
      cost = better ? candidate_cost : cost;
    }
  };
  void choose(int i, const Window& window, int reach, Choice* ahead, Choice* behind) const {
    int32_t present[16];
    const int count = window.ring(reach, present);
    for (int from = 0; from < count; from += kLanes) {
      const Costs costs = lookAtFour(i, present + from, std::min(kLanes, count - from));
      for (int k = 0; k < kLanes; ++k) {
        const int candidate = present[std::min(from + k, count - 1)];
        ahead->consider(candidate, costs.after[k]);
        behind->consider(candidate, costs.before[k]);
      }
    }
  }

  // Finds the best free successor (sign 1) or predecessor (sign -1) of point i; a better claim takes a
  // neighbour over.
  void seek(int i, int sign, const Window& window, Neighbours* found) {
    int best = -1;
    float best_cost = kNoLink;
    for (int reach = 1; reach <= 2 && best < 0; ++reach) {
      look(i, reach, window, found);
      for (int k = found->end[reach - 1]; k < found->end[reach]; ++k) {
        const Neighbours::One& one = found->ring[size_t(k)];
        if (one.sign != sign || one.cost >= best_cost) continue;
        const int j = one.point;
        const int rival = sign > 0 ? previous_[j] : (next_[j] >= 0 ? j : -1);
        if (rival >= 0 && next_cost_[rival] <= one.cost) continue;
        best = j;
        best_cost = one.cost;
      }
    }
    if (best < 0) return;
    const int from = sign > 0 ? i : best, to = sign > 0 ? best : i;
    if (sign > 0 && previous_[to] >= 0) unlink(previous_[to], to);
    if (sign < 0 && next_[from] >= 0) unlink(from, next_[from]);
    next_[from] = to;
    previous_[to] = from;
    next_cost_[from] = best_cost;
  }

  // Ends of at least three points: noise makes shorter ones by the thousand.
  bool looseStart(int i) const { return previous_[i] < 0 && next_[i] >= 0 && next_[next_[i]] >= 0; }
  bool looseEnd(int i) const { return next_[i] < 0 && previous_[i] >= 0 && previous_[previous_[i]] >= 0; }
  // Bridging makes no new ones.
  void findLooseStarts() {
    start_pixels_.reset(edges_.cols, edges_.rows);
    for (int i = 0; i < int(edges_.points.size()); ++i) {
      if (!looseStart(i)) continue;
      start_pixels_.add(edges_.x[i], edges_.y[i], int32_t(starts_.size()));
      starts_.push_back(i);
    }
  }

  // Links the loose end i with a loose start nearby: across a gap of a few pixels, or over an end point that
  // lies beside the other trace's start instead of before it.
  void bridge(int i) {
    constexpr int kReach = 4;
    int from = -1, to = -1, skipped = -1;
    float best = kNoLink;
    const auto consider = [&](int j) {
      if (!looseStart(j) || !roughlyAhead(i, j)) return;
      for (int a : {i, previous_[i]})
        for (int b : {j, next_[j]}) {
          if (a == b) continue;
          const float c = cost(a, b);
          if (c >= best || !inLine(a, b)) continue;
          best = c, from = a, to = b, skipped = j;
        }
    };
    const int x0 = std::max(0, edges_.x[i] - kReach), count = edges_.x[i] + kReach + 1 - x0;
    const int y0 = std::max(0, edges_.y[i] - kReach), y1 = std::min(edges_.rows - 1, edges_.y[i] + kReach);
    for (int y = y0; y <= y1; ++y)
      for (uint32_t left = start_pixels_.run(x0, y, count); left; left &= left - 1)
        consider(starts_[size_t(start_pixels_.point(x0 + lowestBit(left), y))]);
    if (from < 0) return;
    if (from != i) unlink(from, i);
    if (to != skipped) unlink(skipped, to);
    next_[from] = to;
    previous_[to] = from;
    next_cost_[from] = best;
  }

  // Whether the start j can continue the end i at all, their neighbours left alone.
  bool roughlyAhead(int i, int j) const {
    const EdgePoint &p = edges_.points[i], &q = edges_.points[j];
    const Eigen::Vector2f d = q.uv - p.uv;
    const float ahead = p.normal.x() * d.y() - p.normal.y() * d.x();
    return j != i && ahead > -2.5f && p.normal.dot(q.normal) > 0;
  }

  // Does b lie ahead of a, aside by less than a gap of this length excuses?
  bool inLine(int a, int b) const {
    const EdgePoint &p = edges_.points[a], &q = edges_.points[b];
    const Eigen::Vector2f d = q.uv - p.uv;
    const float aside = 0.5f * (std::fabs(p.normal.dot(d)) + std::fabs(q.normal.dot(d)));
    return aside < 0.4f + 0.12f * d.norm();
  }

  void unlink(int from, int to) {
    next_[from] = -1;
    previous_[to] = -1;
    next_cost_[from] = kNoLink;
  }

  const EdgeMap& edges_;
  std::vector<int> next_, previous_;
  std::vector<float> next_cost_;
  std::vector<int> ahead_, behind_;  // a point's own choice
  std::vector<int> starts_;          // loose ones
  EdgePixels start_pixels_;
};

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
  Linker linker(edges);
  linker.link();
  LinkedEdges out;
  out.points.reserve(edges.points.size());
  std::vector<char> used(edges.points.size(), 0);
  const int n = int(edges.points.size()), least = options.min_trace_points;
  for (int i = 0; i < n; ++i)
    if (linker.previous()[i] < 0) append(edges, linker.next(), i, false, least, &used, &out);
  for (int i = 0; i < n; ++i)
    if (!used[i]) append(edges, linker.next(), i, true, least, &used, &out);
  return out;
}

}  // namespace monocular_eye_hand
