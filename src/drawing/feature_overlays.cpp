#include "monocular_eye_hand/drawing/overlays.h"

namespace monocular_eye_hand {
namespace {

constexpr double kDim = 0.55;  // how much of the image shines through below features
const Colour kPlain(60, 230, 250), kJoined(250, 220, 60), kArc(60, 150, 255), kEnd(90, 90, 255);

std::vector<Eigen::Vector2d> pointsOf(const FeatureSet& features, int first, int count) {
  std::vector<Eigen::Vector2d> points;
  for (int k = first; k < first + count && k < int(features.points.size()); ++k)
    points.push_back(features.points[k].uv.cast<double>());
  return points;
}

}  // namespace

void drawTraces(Canvas* canvas, const FeatureSet& features) {
  for (size_t k = 0; k < features.traces.size(); ++k) {
    const EdgeTrace& trace = features.traces[k];
    canvas->polyline(pointsOf(features, trace.first, trace.count), trace.closed, paletteColour(int(k)));
  }
}

void drawSegments(Canvas* canvas, const FeatureSet& features) {
  for (const LineSegment& segment : features.segments) {
    const Colour& colour = segment.joined() ? kJoined : kPlain;
    canvas->line(segment.p, segment.q, colour, segment.joined() ? 1 : 2);
    canvas->dot(segment.p, 2.5, kEnd);
    canvas->dot(segment.q, 2.5, kEnd);
  }
}

void drawArcs(Canvas* canvas, const FeatureSet& features) {
  for (const EllipticArc& arc : features.arcs) canvas->arc(arc.ellipse, arc.start, arc.sweep, kArc, 2);
}

void drawEllipses(Canvas* canvas, const FeatureSet& features) {
  for (size_t k = 0; k < features.ellipses.size(); ++k) {
    const DetectedEllipse& ellipse = features.ellipses[k];
    const Colour colour = paletteColour(int(k) + 1);  // the palette's first is the arcs' orange
    canvas->ellipse(ellipse.ellipse, colour, 1);
    canvas->dot(ellipse.ellipse.centre, 2.5, colour);
    for (int arc : features.arcsOf(ellipse))
      if (arc >= 0 && arc < int(features.arcs.size()))
        canvas->polyline(pointsOf(features, features.arcs[arc].first, features.arcs[arc].count), false,
                         colour, 3);
  }
}

cv::Mat tracesPicture(const cv::Mat& grey, const FeatureSet& features) {
  Canvas canvas(grey, features.camera, kDim);
  drawTraces(&canvas, features);
  return canvas.picture();
}

cv::Mat segmentsPicture(const cv::Mat& grey, const FeatureSet& features) {
  Canvas canvas(grey, features.camera, kDim);
  drawSegments(&canvas, features);
  return canvas.picture();
}

cv::Mat ellipsesPicture(const cv::Mat& grey, const FeatureSet& features) {
  Canvas canvas(grey, features.camera, kDim);
  drawArcs(&canvas, features);
  drawEllipses(&canvas, features);
  return canvas.picture();
}

cv::Mat featuresPicture(const cv::Mat& grey, const FeatureSet& features) {
  Canvas canvas(grey, features.camera, kDim);
  for (const EdgeTrace& trace : features.traces)
    canvas.polyline(pointsOf(features, trace.first, trace.count), trace.closed, {150, 150, 150});
  drawSegments(&canvas, features);
  drawArcs(&canvas, features);
  drawEllipses(&canvas, features);
  return canvas.picture();
}

}  // namespace monocular_eye_hand
