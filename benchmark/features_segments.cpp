// Accuracy of line segments on polygons with known edges, beside EdgeDrawing and LSD.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "features_bench_sets.h"
#include "features_detectors.h"

namespace monocular_eye_hand {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

struct SegmentScores {
  long edges = 0, recalled = 0, detected = 0, matched = 0, fragments = 0;
  std::vector<double> offset, signed_offset, angle, corner;  // px, px outwards, rad, px
};

// What one true edge got: share covered and the longest of its segments.
struct EdgeMatch {
  bool found = false;
  BenchSegment longest;
};

class SegmentScorer {
 public:
  void add(const PolygonImage& image, const std::vector<BenchSegment>& segments) {
    used_.assign(segments.size(), 0);
    for (const Corners& polygon : image.polygons) addPolygon(polygon, segments);
    scores_.detected += long(segments.size());
    for (char used : used_) scores_.matched += used;
  }
  const SegmentScores& scores() const { return scores_; }

 private:
  static constexpr double kShortestEdge = 25, kShortest = 5;  // px

  void addPolygon(const Corners& polygon, const std::vector<BenchSegment>& segments) {
    const size_t n = polygon.size();
    std::vector<EdgeMatch> matches(n);
    for (size_t e = 0; e < n; ++e) matches[e] = match(polygon[e], polygon[(e + 1) % n], segments);
    for (size_t e = 0; e < n; ++e) {
      const EdgeMatch &a = matches[e], &b = matches[(e + 1) % n];
      if (!a.found || !b.found) continue;
      const Eigen::Vector2d da = a.longest.q - a.longest.p, db = b.longest.q - b.longest.p;
      if (std::fabs(cross(da, db)) < 1e-9) continue;
      const double t = cross(b.longest.p - a.longest.p, db) / cross(da, db);
      scores_.corner.push_back((a.longest.p + t * da - polygon[(e + 1) % n]).norm());
    }
  }

  EdgeMatch match(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                  const std::vector<BenchSegment>& segments) {
    EdgeMatch match;
    const double length = (to - from).norm();
    if (length < kShortestEdge) return match;
    ++scores_.edges;
    const Eigen::Vector2d u = (to - from) / length, n(-u.y(), u.x());

    std::vector<std::pair<double, double>> covered;
    double longest = 0;
    for (size_t k = 0; k < segments.size(); ++k) {
      const BenchSegment& s = segments[k];
      if (s.length() < kShortest) continue;
      const double angle = std::asin(std::min(1.0, std::fabs(cross(u, s.q - s.p)) / s.length()));
      double t0 = u.dot(s.p - from), t1 = u.dot(s.q - from);
      if (t0 > t1) std::swap(t0, t1);
      if (angle > 3 * M_PI / 180 * std::max(1.0, 30 / s.length())) continue;
      if (std::fabs(n.dot(0.5 * (s.p + s.q) - from)) > 2 || t1 < 2 || t0 > length - 2) continue;
      used_[k] = 1;
      covered.push_back({std::max(0.0, t0), std::min(length, t1)});
      if (s.length() > longest) {
        longest = s.length();
        match.longest = s;
      }
    }

    if (unionLength(&covered) < 0.7 * length) return match;
    match.found = true;
    ++scores_.recalled;
    scores_.fragments += long(covered.size());
    const BenchSegment& best = match.longest;
    const double offset = n.dot(0.5 * (best.p + best.q) - from);
    scores_.offset.push_back(std::fabs(offset));
    scores_.signed_offset.push_back(-offset);  // the corners turn clockwise on the screen: n points inwards
    scores_.angle.push_back(std::asin(std::fabs(cross(u, best.q - best.p)) / best.length()));
    return match;
  }

  static double unionLength(std::vector<std::pair<double, double>>* intervals) {
    std::sort(intervals->begin(), intervals->end());
    double sum = 0, end = -1;
    for (const auto& [low, high] : *intervals) {
      sum += std::max(0.0, high - std::max(low, end));
      end = std::max(end, high);
    }
    return sum;
  }

  std::vector<char> used_;
  SegmentScores scores_;
};

// Arguments: detector, noise, whether the polygons are filled by area.
void BM_SegmentAccuracy(benchmark::State& state) {
  const Detector detector = Detector(state.range(0));
  const std::vector<PolygonImage> images = polygonSet(double(state.range(1)), state.range(2) != 0);
  SegmentScorer scorer;
  for (auto _ : state)
    for (const PolygonImage& image : images)
      scorer.add(image, detectBy(detector, image.grey, {true, detector == Detector::kOurs}).segments);
  const SegmentScores& s = scorer.scores();
  state.SetLabel(nameOf(detector));
  state.counters["edges"] = double(s.edges);
  state.counters["recall"] = double(s.recalled) / double(s.edges);
  state.counters["precision"] = double(s.matched) / double(std::max(1L, s.detected));
  state.counters["fragments"] = double(s.fragments) / double(std::max(1L, s.recalled));
  state.counters["offset"] = quantile(s.offset, 0.5);
  state.counters["offset_p90"] = quantile(s.offset, 0.9);
  state.counters["outwards"] = quantile(s.signed_offset, 0.5);
  state.counters["angle_deg"] = quantile(s.angle, 0.5) * 180 / M_PI;
  state.counters["corner"] = quantile(s.corner, 0.5);
  state.counters["corner_p90"] = quantile(s.corner, 0.9);
}
BENCHMARK(BM_SegmentAccuracy)
    ->ArgsProduct({{0, 1, 2}, {2, 8}, {0, 1}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace monocular_eye_hand
