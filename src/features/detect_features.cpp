#include <algorithm>
#include <string>

#include "monocular_eye_hand/features/edge_detection.h"
#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/features/joining.h"
#include "monocular_eye_hand/features/linking.h"
#include "monocular_eye_hand/features/splitting.h"
#include "monocular_eye_hand/features/undistortion.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

void checkImage(const cv::Mat& grey, const Camera& camera) {
  if (grey.empty()) throw BadInput("features: the image is empty");
  if (grey.type() != CV_8UC1)
    throw BadInput("features: the image is of type " + cv::typeToString(grey.type()) +
                   ", an 8-bit grey image (CV_8UC1) is needed: convert it first");
  if (grey.cols != camera.width || grey.rows != camera.height)
    throw BadInput("features: the image is " + std::to_string(grey.cols) + " x " + std::to_string(grey.rows) +
                   " px, its camera says " + std::to_string(camera.width) + " x " +
                   std::to_string(camera.height) + ": use the calibration of this resolution");
}

// Points that belong to an ellipse are not split into straight pieces.
std::vector<PointRange> pointsOfEllipses(const FeatureSet& features) {
  std::vector<PointRange> taken;
  for (const DetectedEllipse& e : features.ellipses)
    for (int arc : e.arcs) taken.push_back({features.arcs[arc].first, features.arcs[arc].count});
  std::sort(taken.begin(), taken.end(),
            [](const PointRange& a, const PointRange& b) { return a.first < b.first; });
  return taken;
}

}  // namespace

FeatureSet detectFeatures(const cv::Mat& grey, const Camera& camera, const FeatureOptions& options) {
  checkImage(grey, camera);
  options.check();
  FeatureSet features;
  features.camera = camera;
  const EdgeMap map = detectEdgePoints(grey, options);
  LinkedEdges edges = linkEdges(map, options);
  if (camera.distorted()) edges = undistortEdges(edges, camera, options.min_trace_points);
  rotateClosedTraces(&edges);
  const double correlation = map.correlation_length;
  TracePolygons polygons;
  features.arcs = findArcs(edges, correlation, options, &polygons);
  features.ellipses = joinArcs(edges.points, features.arcs, correlation, options);
  features.segments = findSegments(edges, pointsOfEllipses(features), correlation, options, &polygons);
  const std::vector<LineSegment> joined = joinSegments(features.segments, options);
  features.segments.insert(features.segments.end(), joined.begin(), joined.end());
  features.points = std::move(edges.points);
  features.traces = std::move(edges.traces);
  return features;
}

}  // namespace monocular_eye_hand
