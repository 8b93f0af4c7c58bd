#include "features_detectors.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc.hpp>

namespace monocular_eye_hand {
namespace {

struct Peers {
  cv::Ptr<cv::ximgproc::EdgeDrawing> edge_drawing = cv::ximgproc::createEdgeDrawing();
  cv::Ptr<cv::LineSegmentDetector> lsd = cv::createLineSegmentDetector(cv::LSD_REFINE_STD);
  std::vector<cv::Vec4f> lines;
  std::vector<cv::Vec6d> ellipses;
  Peers() { cv::setNumThreads(1); }
};
Peers& peers() {
  static Peers one;
  return one;
}

void runEdgeDrawing(const cv::Mat& grey, Wanted wanted) {
  Peers& p = peers();
  p.edge_drawing->detectEdges(grey);
  if (wanted.segments) p.edge_drawing->detectLines(p.lines);
  if (wanted.ellipses) p.edge_drawing->detectEllipses(p.ellipses);
}

std::vector<BenchSegment> fromLines(const std::vector<cv::Vec4f>& lines) {
  std::vector<BenchSegment> out;
  out.reserve(lines.size());
  for (const cv::Vec4f& l : lines) out.push_back({{l[0], l[1]}, {l[2], l[3]}});
  return out;
}

// A circle of EdgeDrawing has a radius at [2], an ellipse its semi-axes at [3] and [4], the other part is 0.
std::vector<Ellipse> fromEdgeDrawing(const std::vector<cv::Vec6d>& found) {
  std::vector<Ellipse> out;
  for (const cv::Vec6d& v : found) {
    Ellipse e;
    e.centre = {v[0], v[1]};
    e.a = v[2] + v[3];
    e.b = v[2] + v[4];
    e.angle = v[5] * M_PI / 180;
    if (e.b > e.a) {
      std::swap(e.a, e.b);
      e.angle += M_PI / 2;
    }
    out.push_back(e);
  }
  return out;
}

BenchFeatures fromOurs(const FeatureSet& set) {
  std::vector<char> replaced(set.segments.size(), 0);
  for (const LineSegment& s : set.segments)
    for (int piece : set.piecesOf(s)) replaced[piece] = 1;
  BenchFeatures out;
  for (size_t i = 0; i < set.segments.size(); ++i)
    if (!replaced[i]) out.segments.push_back({set.segments[i].p, set.segments[i].q});
  for (const DetectedEllipse& e : set.ellipses) out.ellipses.push_back(e.ellipse);
  return out;
}

}  // namespace

const char* nameOf(Detector detector) {
  switch (detector) {
    case Detector::kOurs:
      return "ours";
    case Detector::kEdgeDrawing:
      return "EdgeDrawing";
    case Detector::kLsd:
      return "LSD";
  }
  return "";
}

BenchFeatures detectBy(Detector detector, const cv::Mat& grey, Wanted wanted) {
  BenchFeatures out;
  if (detector == Detector::kOurs) {
    out = fromOurs(detectFeatures(grey, benchCamera(grey)));
  } else if (detector == Detector::kEdgeDrawing) {
    runEdgeDrawing(grey, wanted);
    out = {fromLines(peers().lines), fromEdgeDrawing(peers().ellipses)};
  } else {
    peers().lsd->detect(grey, peers().lines);
    out.segments = fromLines(peers().lines);
  }
  if (!wanted.segments) out.segments.clear();
  if (!wanted.ellipses) out.ellipses.clear();
  return out;
}

double secondsBy(Detector detector, const cv::Mat& grey, Wanted wanted) {
  static FeatureDetector ours;
  static FeatureSet features;
  peers();
  const Camera camera = benchCamera(grey);
  const double begin = threadSeconds();
  if (detector == Detector::kOurs)
    ours.detect(grey, camera, &features);
  else if (detector == Detector::kEdgeDrawing)
    runEdgeDrawing(grey, wanted);
  else
    peers().lsd->detect(grey, peers().lines);
  return threadSeconds() - begin;
}

Camera benchCamera(const cv::Mat& grey) {
  Camera camera;
  camera.width = grey.cols;
  camera.height = grey.rows;
  camera.fx = camera.fy = 1.1 * grey.cols;
  camera.cx = (grey.cols - 1) / 2.0;
  camera.cy = (grey.rows - 1) / 2.0;
  return camera;
}

double threadSeconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const double at = share * double(values.size() - 1);
  const size_t i = size_t(at);
  return i + 1 < values.size() ? values[i] + (at - double(i)) * (values[i + 1] - values[i]) : values[i];
}

}  // namespace monocular_eye_hand
