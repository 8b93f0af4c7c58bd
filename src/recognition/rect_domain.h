#pragma once
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

#include "monocular_eye_hand/geometry/camera.h"

namespace monocular_eye_hand {

/// The part of the rectified image plane that is looked at: pixel (u, v) lies at (u - u0, v - v0) of the
/// maps. With a distorting lens it is larger than the image, and `valid` marks what the image covers.
struct RectDomain {
  int u0 = 0, v0 = 0, width = 0, height = 0;
  cv::Mat valid;  ///< CV_8UC1, 255 where the image covers the pixel; empty: everywhere

  bool contains(double u, double v) const {
    const int x = int(std::lround(u)) - u0, y = int(std::lround(v)) - v0;
    return x >= 0 && y >= 0 && x < width && y < height && (valid.empty() || valid.at<uint8_t>(y, x) != 0);
  }
};
RectDomain rectDomain(const Camera& camera);

/// The grey image on the domain: the image itself without distortion, resampled (bilinear) with it.
cv::Mat rectifiedGrey(const cv::Mat& grey, const Camera& camera, const RectDomain& domain);

}  // namespace monocular_eye_hand
