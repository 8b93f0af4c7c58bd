#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "features/edge_detection.h"
#include "features/joining.h"
#include "features/linking.h"
#include "features/splitting.h"
#include "features/undistortion.h"
#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

void checkImage(const cv::Mat& grey, const Camera& camera) {
  if (grey.empty()) throw BadInput("features: the image is empty");
  if (grey.type() != CV_8UC1)
    throw BadInput("features: the image is of type " + cv::typeToString(grey.type()) +
                   ", an 8-bit grey image (CV_8UC1) is needed: convert it first");
  if (grey.cols != camera.width || grey.rows != camera.height)
    throw BadInput(fmt::format(
        "features: the image is {} x {} px, its camera says {} x {}: use the calibration of this resolution",
        grey.cols, grey.rows, camera.width, camera.height));
}

// Points that belong to an ellipse are not split into straight pieces.
void pointsOfEllipses(const FeatureSet& features, std::vector<PointRange>* taken) {
  taken->clear();
  for (int arc : features.ellipse_arcs)
    taken->push_back({features.arcs[arc].first, features.arcs[arc].count});
  std::sort(taken->begin(), taken->end(),
            [](const PointRange& a, const PointRange& b) { return a.first < b.first; });
}

FeatureOptions checked(const FeatureOptions& options) {
  options.check();
  return options;
}

}  // namespace

struct FeatureDetector::Stages {
  explicit Stages(const FeatureOptions& o)
      : options(checked(o)),
        edge_detector(options),
        edge_linker(options),
        arc_finder(options),
        arc_joiner(options),
        segment_finder(options),
        segment_joiner(options) {}

  void run(const cv::Mat& grey, const Camera& camera, FeatureSet* out) {
    out->camera = camera;
    LinkedEdges edges{std::move(out->points), std::move(out->traces)};  // what the set has reserved stays its
    findEdges(grey, camera, &edges);
    const double correlation = map.correlation_length;
    arc_finder.find(edges, correlation, &polygons, &out->arcs);
    arc_joiner.join(edges.points, out->arcs, correlation, &out->ellipses, &out->ellipse_arcs);
    pointsOfEllipses(*out, &taken);
    segment_finder.find(edges, taken, correlation, &polygons, &out->segments);
    segment_joiner.join(&out->segments, &out->joined_pieces);
    out->points = std::move(edges.points);
    out->traces = std::move(edges.traces);
  }

  void findEdges(const cv::Mat& grey, const Camera& camera, LinkedEdges* out) {
    edge_detector.detect(grey, &map);
    if (camera.distorted()) {
      edge_linker.link(map, &raw);
      undistortEdges(raw, camera, options.min_trace_points, out);
    } else {
      edge_linker.link(map, out);
    }
    rotateClosedTraces(out);
  }

  const FeatureOptions options;
  EdgeDetector edge_detector;
  EdgeLinker edge_linker;
  ArcFinder arc_finder;
  ArcJoiner arc_joiner;
  SegmentFinder segment_finder;
  SegmentJoiner segment_joiner;
  EdgeMap map;
  LinkedEdges raw;  // of a camera with distortion
  TracePolygons polygons;
  std::vector<PointRange> taken;
};

FeatureDetector::FeatureDetector(const FeatureOptions& options)
    : stages_(std::make_unique<Stages>(options)) {}
FeatureDetector::FeatureDetector(FeatureDetector&& other) noexcept = default;
FeatureDetector& FeatureDetector::operator=(FeatureDetector&& other) noexcept = default;
FeatureDetector::~FeatureDetector() = default;

void FeatureDetector::detect(const cv::Mat& grey, const Camera& camera, FeatureSet* out) {
  checkImage(grey, camera);
  stages_->run(grey, camera, out);
}

FeatureSet detectFeatures(const cv::Mat& grey, const Camera& camera, const FeatureOptions& options) {
  FeatureSet features;
  FeatureDetector(options).detect(grey, camera, &features);
  return features;
}

}  // namespace monocular_eye_hand
