// Time from a camera image to segments and ellipses beside EdgeDrawing's lines and ellipses, in turns.
#include <benchmark/benchmark.h>

#include <array>
#include <opencv2/imgproc.hpp>

#include "features/edge_detection.h"
#include "features/joining.h"
#include "features/linking.h"
#include "features/splitting.h"
#include "features_bench_sets.h"
#include "features_detectors.h"

namespace monocular_eye_hand {
namespace {

struct Size {
  int width, height;
};
constexpr Size kSizes[] = {{640, 480}, {1280, 720}, {1920, 1080}};

// The middle of the image enlarged to fill the size.
cv::Mat enlarged(const cv::Mat& grey, Size size) {
  const double factor = std::max(double(size.width) / grey.cols, double(size.height) / grey.rows);
  if (factor == 1 && grey.rows == size.height && grey.cols == size.width) return grey;
  cv::Mat large;
  cv::resize(grey, large, {}, factor, factor, cv::INTER_CUBIC);
  const cv::Rect middle((large.cols - size.width) / 2, (large.rows - size.height) / 2, size.width,
                        size.height);
  return large(middle).clone();
}

// The stages of a FeatureDetector, as it keeps them and what they fill from image to image.
struct Stages {
  FeatureOptions options;
  EdgeDetector edge_detector{options};
  EdgeLinker edge_linker{options};
  ArcFinder arc_finder{options};
  ArcJoiner arc_joiner{options};
  SegmentFinder segment_finder{options};
  SegmentJoiner segment_joiner{options};
  EdgeMap map;
  LinkedEdges edges;
  TracePolygons polygons;
  FeatureSet set;
};

// What a FeatureDetector does one after the other; segments here of all points, those on ellipses too.
constexpr std::array<const char*, 6> kStages = {"edge_points_ms", "linking_ms",  "arcs_ms",
                                                "ellipses_ms",    "segments_ms", "joining_ms"};
std::array<double, kStages.size()> stageMilliseconds(const cv::Mat& grey) {
  static Stages s;
  std::array<double, kStages.size()> times{};
  double last = threadSeconds();
  const auto lap = [&](size_t stage) {
    const double now = threadSeconds();
    times[stage] = 1e3 * (now - last);
    last = now;
  };
  s.edge_detector.detect(grey, &s.map);
  lap(0);
  s.edge_linker.link(s.map, &s.edges);
  rotateClosedTraces(&s.edges);
  lap(1);
  const double correlation = s.map.correlation_length;
  s.arc_finder.find(s.edges, correlation, &s.polygons, &s.set.arcs);
  lap(2);
  s.arc_joiner.join(s.edges.points, s.set.arcs, correlation, &s.set.ellipses, &s.set.ellipse_arcs);
  lap(3);
  s.segment_finder.find(s.edges, {}, correlation, &s.polygons, &s.set.segments);
  lap(4);
  s.segment_joiner.join(&s.set.segments, &s.set.joined_pieces);
  lap(5);
  return times;
}

// Arguments: data set, size. One image after the other; of each the median of turns of all detectors.
void BM_FrontEnd(benchmark::State& state) {
  constexpr int kTurns = 5;
  const std::vector<BenchDataset> sets = benchDatasets();
  if (size_t(state.range(0)) >= sets.size()) {
    state.SkipWithError("MONOCULAR_EYE_HAND_DATA names no folder with the data sets");
    return;
  }

  const BenchDataset& set = sets[size_t(state.range(0))];
  const Size size = kSizes[state.range(1)];
  std::vector<double> ours, edge_drawing, lsd, ratio;
  std::array<std::vector<double>, kStages.size()> stages;

  for (auto _ : state)
    for (const BopImage& image : set.images.images) {
      const cv::Mat grey = enlarged(loadBopImage(image), size);
      std::vector<double> times[kDetectors];
      for (int turn = 0; turn < kTurns; ++turn)
        for (int d = 0; d < kDetectors; ++d)
          if (d != int(Detector::kLsd) || turn == 0) times[d].push_back(secondsBy(Detector(d), grey, {}));
      ours.push_back(1e3 * quantile(times[0], 0.5));
      edge_drawing.push_back(1e3 * quantile(times[1], 0.5));
      lsd.push_back(1e3 * quantile(times[2], 0.5));
      ratio.push_back(ours.back() / edge_drawing.back());
      const auto stage_times = stageMilliseconds(grey);
      for (size_t k = 0; k < kStages.size(); ++k) stages[k].push_back(stage_times[k]);
    }

  state.SetLabel(set.name + " " + std::to_string(size.width) + " x " + std::to_string(size.height));
  state.counters["images"] = double(ours.size());
  state.counters["ours_ms"] = quantile(ours, 0.5);
  state.counters["ours_worst_ms"] = quantile(ours, 1);
  state.counters["peer_ms"] = quantile(edge_drawing, 0.5);
  state.counters["peer_worst_ms"] = quantile(edge_drawing, 1);
  state.counters["lsd_ms"] = quantile(lsd, 0.5);
  state.counters["ratio"] = quantile(ratio, 0.5);
  for (size_t k = 0; k < kStages.size(); ++k) state.counters[kStages[k]] = quantile(stages[k], 0.5);
  state.counters["pixels"] = double(size.width) * size.height;
}
BENCHMARK(BM_FrontEnd)->ArgsProduct({{0, 1, 2}, {0, 1, 2}})->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace monocular_eye_hand
