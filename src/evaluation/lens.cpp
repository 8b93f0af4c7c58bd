#include "monocular_eye_hand/evaluation/lens.h"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

bool sameLens(const Camera& a, const Camera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx &&
         a.cy == b.cy && a.model == b.model && a.d == b.d;
}

}  // namespace

cv::Mat LensWarp::apply(const cv::Mat& ideal, const Camera& lens) {
  if (ideal.cols != lens.width || ideal.rows != lens.height)
    throw BadInput(fmt::format("the image has {} x {} pixels, its camera {} x {}", ideal.cols, ideal.rows,
                               lens.width, lens.height));
  if (map_.empty() || !sameLens(lens, lens_)) {
    lens_ = lens;
    map_.create(ideal.size(), CV_32FC2);
    for (int v = 0; v < map_.rows; ++v)
      for (int u = 0; u < map_.cols; ++u) {
        const Eigen::Vector2d uv_rect = lens.undistort(Eigen::Vector2d(u, v));
        map_.at<cv::Vec2f>(v, u) = cv::Vec2f(float(uv_rect.x()), float(uv_rect.y()));
      }
  }
  cv::Mat raw;
  cv::remap(ideal, raw, map_, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return raw;
}

CameraImage resized(const CameraImage& input, double factor) {
  if (!(factor > 0)) throw BadInput(fmt::format("scale = {:g} must be positive", factor));
  CameraImage out;
  out.camera = input.camera.resized(factor);
  if (out.camera.width < 1 || out.camera.height < 1)
    throw BadInput(fmt::format("scale = {:g} leaves no pixel", factor));
  cv::resize(input.grey, out.grey, {out.camera.width, out.camera.height}, 0, 0,
             factor > 1 ? cv::INTER_CUBIC : cv::INTER_AREA);
  return out;
}

}  // namespace monocular_eye_hand
