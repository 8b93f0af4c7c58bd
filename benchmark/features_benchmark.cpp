// Time of the front end, stage by stage, on synthetic clutter of growing size, and on a folder of images when
// one is named: MONOCULAR_EYE_HAND_IMAGES=<folder of PNG files> features_benchmark
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "features/edge_detection.h"
#include "features/joining.h"
#include "features/linking.h"
#include "features/splitting.h"
#include "features/undistortion.h"
#include "features_detectors.h"
#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {
namespace {

// Polygons and ellipses, as many per area at every size; noise 3.
cv::Mat clutter(int width, int height) {
  std::mt19937 g(5);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(g);
  };
  cv::Mat image(height, width, CV_8U, cv::Scalar(100));
  for (int k = 0; k < width * height / 6000; ++k) {
    const cv::Point2f c(float(uniform(0, width)), float(uniform(0, height)));
    const cv::Scalar grey(int(uniform(20, 240)));
    const double r = uniform(8, 60);
    if (k % 3 == 0) {
      cv::ellipse(image, c, cv::Size(int(r), int(r * uniform(0.3, 1))), uniform(0, 180), 0, 360, grey,
                  cv::FILLED);
      continue;
    }
    std::vector<cv::Point> corners;
    const double turn = uniform(0, 6.28);
    for (int i = 0; i < 5; ++i)
      corners.emplace_back(int(c.x + r * std::cos(turn + 1.257 * i)),
                           int(c.y + r * std::sin(turn + 1.257 * i)));
    cv::fillConvexPoly(image, corners, grey);
  }
  cv::GaussianBlur(image, image, {0, 0}, 0.8);
  std::normal_distribution<double> noise(0, 3);
  for (int i = 0; i < width * height; ++i) image.data[i] = cv::saturate_cast<uchar>(image.data[i] + noise(g));
  return image;
}

// Argument: image width; 4:3.
void BM_DetectFeatures(benchmark::State& state) {
  const cv::Mat image = clutter(int(state.range(0)), int(state.range(0)) * 3 / 4);
  const Camera camera = benchCamera(image);
  FeatureDetector detector;
  FeatureSet features;
  for (auto _ : state) detector.detect(image, camera, &features);
  state.counters["points"] = double(features.points.size());
  state.counters["segments"] = double(features.segments.size());
  state.counters["ellipses"] = double(features.ellipses.size());
  state.counters["ns_per_pixel"] =
      benchmark::Counter(double(image.total()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(BM_DetectFeatures)->Arg(320)->Arg(640)->Arg(1280)->Arg(1920)->Unit(benchmark::kMillisecond);

struct Stages {
  cv::Mat image = clutter(640, 480);
  FeatureOptions options;
  EdgeDetector edge_detector{options};
  EdgeLinker edge_linker{options};
  EdgeMap map;
  LinkedEdges edges;
  Stages() {
    edge_detector.detect(image, &map);
    edge_linker.link(map, &edges);
  }
};

void BM_EdgePoints(benchmark::State& state) {
  Stages s;
  for (auto _ : state) s.edge_detector.detect(s.image, &s.map);
}
BENCHMARK(BM_EdgePoints)->Unit(benchmark::kMillisecond);

void BM_Linking(benchmark::State& state) {
  Stages s;
  for (auto _ : state) s.edge_linker.link(s.map, &s.edges);
}
BENCHMARK(BM_Linking)->Unit(benchmark::kMillisecond);

void BM_Undistortion(benchmark::State& state) {
  const Stages s;
  Camera camera = benchCamera(s.image);
  camera.model = DistortionModel::kPlumbBob;
  camera.d = {-0.25, 0.08, 0.001, -0.001, 0, 0, 0, 0};
  LinkedEdges rectified;
  for (auto _ : state) undistortEdges(s.edges, camera, s.options.min_trace_points, &rectified);
  state.counters["points"] = double(s.edges.points.size());
}
BENCHMARK(BM_Undistortion)->Unit(benchmark::kMillisecond);

void BM_Arcs(benchmark::State& state) {
  const Stages s;
  ArcFinder finder(s.options);
  TracePolygons polygons;
  std::vector<EllipticArc> arcs;
  for (auto _ : state) finder.find(s.edges, s.map.correlation_length, &polygons, &arcs);
}
BENCHMARK(BM_Arcs)->Unit(benchmark::kMillisecond);

void BM_Segments(benchmark::State& state) {
  const Stages s;
  SegmentFinder finder(s.options);
  TracePolygons none;  // so that it makes its own
  std::vector<LineSegment> segments;
  for (auto _ : state) finder.find(s.edges, {}, s.map.correlation_length, &none, &segments);
}
BENCHMARK(BM_Segments)->Unit(benchmark::kMillisecond);

void BM_Images(benchmark::State& state) {
  const char* folder = std::getenv("MONOCULAR_EYE_HAND_IMAGES");
  std::vector<cv::String> files;
  if (folder) cv::glob(std::string(folder) + "/*.png", files);
  std::vector<cv::Mat> images;
  for (const cv::String& file : files) images.push_back(cv::imread(file, cv::IMREAD_GRAYSCALE));
  if (images.empty()) {
    state.SkipWithError("MONOCULAR_EYE_HAND_IMAGES names no folder with PNG files");
    return;
  }
  FeatureDetector detector;
  FeatureSet features;
  size_t i = 0;
  for (auto _ : state) {
    const cv::Mat& image = images[i++ % images.size()];
    detector.detect(image, benchCamera(image), &features);
  }
}
BENCHMARK(BM_Images)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace monocular_eye_hand
