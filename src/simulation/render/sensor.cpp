#include "simulation/render/sensor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "monocular_eye_hand/geometry/random.h"

namespace monocular_eye_hand {

double automaticExposure(const cv::Mat1f& light, double mean, double saturated) {
  constexpr double kBright = 0.9;
  std::vector<float> values(light.begin(), light.end());
  const auto bright = values.begin() + std::ptrdiff_t((1 - saturated) * double(values.size() - 1));
  std::nth_element(values.begin(), bright, values.end());
  const double average = cv::mean(light)[0];
  if (!(average > 0)) return 1;
  return std::min(mean / average, kBright / std::max(double(*bright), 1e-9));
}

cv::Mat1f blurred(const cv::Mat1f& radiance, double sigma) {
  if (sigma <= 0) return radiance;
  cv::Mat1f out;
  const int radius = std::max(1, int(std::ceil(4 * sigma)));
  cv::GaussianBlur(radiance, out, cv::Size(2 * radius + 1, 2 * radius + 1), sigma, sigma,
                   cv::BORDER_REPLICATE);
  return out;
}

namespace {

void darkenCorners(double vignetting, cv::Mat1f* light) {
  const double x0 = 0.5 * (light->cols - 1), y0 = 0.5 * (light->rows - 1);
  const double corner = x0 * x0 + y0 * y0;
  for (int y = 0; y < light->rows; ++y)
    for (int x = 0; x < light->cols; ++x) {
      const double share = ((x - x0) * (x - x0) + (y - y0) * (y - y0)) / std::max(corner, 1.0);
      (*light)(y, x) *= float(1 - vignetting * share);
    }
}

}  // namespace

cv::Mat sensorImage(const cv::Mat1f& radiance, const RenderOptions& options, double* exposure) {
  cv::Mat1f light = blurred(radiance, options.blur_sigma);
  if (options.vignetting > 0) {
    light = light.clone();
    darkenCorners(options.vignetting, &light);
  }

  *exposure =
      options.exposure > 0 ? options.exposure : automaticExposure(light, options.mean, options.saturated);
  if (options.sharpening > 0) light = light + options.sharpening * (light - blurred(light, 1));

  cv::Mat grey(light.rows, light.cols, CV_8UC1);
  Generator random(options.seed ^ 0xa5a5u);
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x) {
      const double linear = std::clamp(*exposure * light(y, x), 0.0, 1.0);
      const double value = 255 * (options.gamma == 1 ? linear : std::pow(linear, 1 / options.gamma));
      const double variance = options.noise_sigma * options.noise_sigma + options.shot_noise * value;
      const double noise = variance > 0 ? std::sqrt(variance) * random.gaussian() : 0;
      grey.at<uchar>(y, x) = cv::saturate_cast<uchar>(std::lround(value + noise));
    }
  return grey;
}

}  // namespace monocular_eye_hand
