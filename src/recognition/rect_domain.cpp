#include "recognition/rect_domain.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace monocular_eye_hand {

RectDomain rectDomain(const Camera& camera) {
  RectDomain domain;
  domain.width = camera.width;
  domain.height = camera.height;
  if (!camera.distorted()) return domain;
  // The image's border, rectified; kept within half an image of it, where any calibration is extrapolating.
  double lo_u = 1e9, lo_v = 1e9, hi_u = -1e9, hi_v = -1e9;
  const auto include = [&](double u, double v) {
    const Eigen::Vector2d p = camera.undistort({u, v});
    if (!p.allFinite()) return;
    lo_u = std::min(lo_u, p.x());
    hi_u = std::max(hi_u, p.x());
    lo_v = std::min(lo_v, p.y());
    hi_v = std::max(hi_v, p.y());
  };
  for (int u = 0; u < camera.width; u += 8) {
    include(u, 0);
    include(u, camera.height - 1);
  }
  for (int v = 0; v < camera.height; v += 8) {
    include(0, v);
    include(camera.width - 1, v);
  }
  include(camera.width - 1, camera.height - 1);
  const double w = camera.width, h = camera.height;

  domain.u0 = int(std::floor(std::max(lo_u, -w / 2)));
  domain.v0 = int(std::floor(std::max(lo_v, -h / 2)));
  domain.width = int(std::ceil(std::min(hi_u, 1.5 * w))) - domain.u0 + 1;
  domain.height = int(std::ceil(std::min(hi_v, 1.5 * h))) - domain.v0 + 1;
  domain.valid.create(domain.height, domain.width, CV_8UC1);
  for (int y = 0; y < domain.height; ++y)
    for (int x = 0; x < domain.width; ++x) {
      const Eigen::Vector2d raw = camera.distort({double(x + domain.u0), double(y + domain.v0)});
      const bool inside = raw.x() >= 0 && raw.y() >= 0 && raw.x() <= w - 1 && raw.y() <= h - 1;
      domain.valid.at<uint8_t>(y, x) = inside ? 255 : 0;
    }
  return domain;
}

cv::Mat rectifiedGrey(const cv::Mat& grey, const Camera& camera, const RectDomain& domain) {
  if (!camera.distorted()) return grey;
  cv::Mat map_u(domain.height, domain.width, CV_32F), map_v(domain.height, domain.width, CV_32F), out;
  for (int y = 0; y < domain.height; ++y)
    for (int x = 0; x < domain.width; ++x) {
      const Eigen::Vector2d raw = camera.distort({double(x + domain.u0), double(y + domain.v0)});
      map_u.at<float>(y, x) = float(raw.x());
      map_v.at<float>(y, x) = float(raw.y());
    }
  cv::remap(grey, out, map_u, map_v, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return out;
}

}  // namespace monocular_eye_hand
