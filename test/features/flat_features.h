#pragma once
#include <initializer_list>
#include <vector>

#include "monocular_eye_hand/features/features.h"
#include "synthetic.h"

namespace monocular_eye_hand {

/// Everything detected in an image as one row of numbers.
inline std::vector<double> flatFeatures(const cv::Mat& grey) {
  const FeatureSet features = detectFeatures(grey, testCamera(grey.cols, grey.rows));
  std::vector<double> flat;
  const auto put = [&](std::initializer_list<double> values) {
    flat.insert(flat.end(), values.begin(), values.end());
  };
  for (const EdgePoint& p : features.points)
    put({p.uv.x(), p.uv.y(), p.normal.x(), p.normal.y(), p.gradient, p.sigma, p.blur});
  for (const EdgeTrace& t : features.traces) put({double(t.first), double(t.count), double(t.closed)});
  for (const LineSegment& s : features.segments)
    put({s.p.x(), s.p.y(), s.q.x(), s.q.y(), s.sigma_offset, s.sigma_angle, double(s.pieces.size())});
  for (const DetectedEllipse& e : features.ellipses) {
    put({e.ellipse.centre.x(), e.ellipse.centre.y(), e.ellipse.a, e.ellipse.b, e.ellipse.angle, e.coverage});
    flat.insert(flat.end(), e.covariance.data(), e.covariance.data() + e.covariance.size());
  }
  return flat;
}

}  // namespace monocular_eye_hand
