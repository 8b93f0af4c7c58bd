#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// What every detector answers, in the form in which they are compared.
struct BenchSegment {
  Eigen::Vector2d p, q;
  double length() const { return (q - p).norm(); }
};
struct BenchFeatures {
  std::vector<BenchSegment> segments;
  std::vector<Ellipse> ellipses;
};

enum class Detector { kOurs = 0, kEdgeDrawing = 1, kLsd = 2 };
constexpr int kDetectors = 3;
const char* nameOf(Detector detector);

struct Wanted {
  bool segments = true, ellipses = true;
};
/// Default options everywhere, OpenCV on one thread. Of ours, a joined segment stands in place of its pieces.
BenchFeatures detectBy(Detector detector, const cv::Mat& grey, Wanted wanted);
/// CPU time of this thread for the detector alone [s], without conversions.
double secondsBy(Detector detector, const cv::Mat& grey, Wanted wanted);

/// A camera without distortion for an image of any size.
Camera benchCamera(const cv::Mat& grey);
/// CPU time of this thread [s].
double threadSeconds();
/// The value below which `share` of the values lie; NaN without values.
double quantile(std::vector<double> values, double share);

}  // namespace monocular_eye_hand
