// Recall, precision, accuracy and time of ellipses on occluded ellipses beside polygons and lines, beside
// EdgeDrawing.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "features_bench_sets.h"
#include "features_detectors.h"

namespace monocular_eye_hand {
namespace {

bool inside(const Ellipse& e, double c, double s, double u, double v) {
  const double du = u - e.centre.x(), dv = v - e.centre.y();
  const double x = (c * du + s * dv) / e.a, y = (-s * du + c * dv) / e.b;
  return x * x + y * y <= 1;
}

// Area of the intersection over that of the union, on 200 x 200 samples of their common bounding box.
double intersectionOverUnion(const Ellipse& p, const Ellipse& q) {
  constexpr int kSamples = 200;
  if ((p.centre - q.centre).norm() > p.a + q.a) return 0;
  const auto low = [&](int i) { return std::min(p.centre[i] - p.a, q.centre[i] - q.a); };
  const auto high = [&](int i) { return std::max(p.centre[i] + p.a, q.centre[i] + q.a); };
  const double cp = std::cos(p.angle), sp = std::sin(p.angle), cq = std::cos(q.angle), sq = std::sin(q.angle);
  const double u0 = low(0), v0 = low(1), du = (high(0) - u0) / kSamples, dv = (high(1) - v0) / kSamples;
  long both = 0, any = 0;
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < kSamples; ++i) {
      const double u = u0 + (i + 0.5) * du, v = v0 + (j + 0.5) * dv;
      const bool in_p = inside(p, cp, sp, u, v), in_q = inside(q, cq, sq, u, v);
      both += in_p && in_q;
      any += in_p || in_q;
    }
  return any ? double(both) / double(any) : 0;
}

struct EllipseScores {
  static constexpr double kMatch = 0.8;  // least intersection over union
  long truth = 0, found = 0, detected = 0, right = 0;
  std::vector<double> centre, axes;  // px

  void add(const std::vector<Ellipse>& truths, const std::vector<Ellipse>& detections) {
    std::vector<char> matched(detections.size(), 0);
    for (const Ellipse& t : truths) {
      double best = 0;
      const Ellipse* at = nullptr;
      for (size_t k = 0; k < detections.size(); ++k) {
        const double overlap = intersectionOverUnion(t, detections[k]);
        if (overlap >= kMatch) matched[k] = 1;
        if (overlap > best) {
          best = overlap;
          at = &detections[k];
        }
      }
      if (best < kMatch) continue;
      ++found;
      centre.push_back((at->centre - t.centre).norm());
      axes.push_back(std::max(std::fabs(at->a - t.a), std::fabs(at->b - t.b)));
    }
    truth += long(truths.size());
    detected += long(detections.size());
    for (char m : matched) right += m;
  }
  double recall() const { return double(found) / double(std::max(1L, truth)); }
  double precision() const { return detected ? double(right) / double(detected) : 1; }
  /// Second detections of one ellipse count neither for nor against.
  double f1() const { return 2.0 * double(found) / double(truth + detected - (right - found)); }
};

// Argument: detector.
void BM_EllipseAccuracy(benchmark::State& state) {
  const Detector detector = Detector(state.range(0));
  EllipseScores all;
  std::array<EllipseScores, 6> by_occlusion;
  for (auto _ : state)
    for (const EllipseImage& image : ellipseSet()) {
      const std::vector<Ellipse> found = detectBy(detector, image.grey, {false, true}).ellipses;
      all.add(image.ellipses, found);
      by_occlusion[size_t(std::lround(10 * image.occlusion))].add(image.ellipses, found);
    }
  state.SetLabel(nameOf(detector));
  state.counters["ellipses"] = double(all.truth);
  state.counters["recall"] = all.recall();
  state.counters["precision"] = all.precision();
  state.counters["f1"] = all.f1();
  state.counters["centre"] = quantile(all.centre, 0.5);
  state.counters["centre_p90"] = quantile(all.centre, 0.9);
  state.counters["axes"] = quantile(all.axes, 0.5);
  for (size_t k = 0; k < by_occlusion.size(); ++k) {
    const std::string at = std::to_string(10 * k);
    state.counters["recall_" + at] = by_occlusion[k].recall();
    state.counters["precision_" + at] = by_occlusion[k].precision();
  }
}
BENCHMARK(BM_EllipseAccuracy)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kMillisecond);

// Ours finds lines as well; EdgeDrawing is timed for ellipses alone and for both.
void BM_EllipseTime(benchmark::State& state) {
  std::vector<double> ours, alone, both;
  for (auto _ : state)
    for (const EllipseImage& image : ellipseSet()) {
      std::array<std::vector<double>, 3> times;
      for (int repetition = 0; repetition < 3; ++repetition) {
        times[0].push_back(secondsBy(Detector::kOurs, image.grey, {}));
        times[1].push_back(secondsBy(Detector::kEdgeDrawing, image.grey, {false, true}));
        times[2].push_back(secondsBy(Detector::kEdgeDrawing, image.grey, {}));
      }
      ours.push_back(quantile(times[0], 0.5));
      alone.push_back(quantile(times[1], 0.5));
      both.push_back(quantile(times[2], 0.5));
    }
  state.counters["ours_ms"] = 1e3 * quantile(ours, 0.5);
  state.counters["peer_ms"] = 1e3 * quantile(alone, 0.5);
  state.counters["peer_both_ms"] = 1e3 * quantile(both, 0.5);
}
BENCHMARK(BM_EllipseTime)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace monocular_eye_hand
