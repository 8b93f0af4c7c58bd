#pragma once
#include <initializer_list>
#include <vector>

#include "monocular_eye_hand/features/features.h"
#include "synthetic.h"

namespace monocular_eye_hand {

/// Features as one row of numbers.
inline std::vector<double> flat(const FeatureSet& features) {
  std::vector<double> row;
  const auto put = [&](std::initializer_list<double> values) {
    row.insert(row.end(), values.begin(), values.end());
  };

  for (const EdgePoint& p : features.points)
    put({p.uv.x(), p.uv.y(), p.normal.x(), p.normal.y(), p.gradient, p.sigma, p.blur});
  for (const EdgeTrace& t : features.traces) put({double(t.first), double(t.count), double(t.closed)});
  for (const LineSegment& s : features.segments)
    put({s.p.x(), s.p.y(), s.q.x(), s.q.y(), s.sigma_offset, s.sigma_angle, double(s.piece_count)});
  for (const EllipticArc& a : features.arcs)
    put({a.start, a.sweep, a.rms, double(a.trace), double(a.first), double(a.count)});
  for (const DetectedEllipse& e : features.ellipses) {
    put({e.ellipse.centre.x(), e.ellipse.centre.y(), e.ellipse.a, e.ellipse.b, e.ellipse.angle, e.coverage});
    row.insert(row.end(), e.covariance.data(), e.covariance.data() + e.covariance.size());
    put({double(e.arc_count)});
  }
  row.insert(row.end(), features.joined_pieces.begin(), features.joined_pieces.end());
  row.insert(row.end(), features.ellipse_arcs.begin(), features.ellipse_arcs.end());
  return row;
}

/// Everything detected in an image.
inline std::vector<double> flatFeatures(const cv::Mat& grey) {
  return flat(detectFeatures(grey, testCamera(grey.cols, grey.rows)));
}

}  // namespace monocular_eye_hand
