#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "monocular_eye_hand/features/features.h"
#include "support/camera.h"
#include "support/random.h"

namespace monocular_eye_hand {

inline Camera testCamera(int width, int height) { return centredCamera(width, height, 1.1 * width); }

/// A filled shape: `inside` tells whether a rectified pixel position lies in it.
struct ConvexPolygon {
  std::vector<Eigen::Vector2d> corners;  // in an order that keeps the inside on one side
  double grey = 0;
  bool inside(const Eigen::Vector2d& p) const {
    int side = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d &a = corners[i], d = corners[(i + 1) % corners.size()] - a, e = p - a;
      const int s = d.x() * e.y() - d.y() * e.x() > 0 ? 1 : -1;
      if (side != 0 && s != side) return false;
      side = s;
    }
    return true;
  }
};

struct FilledEllipse {
  Ellipse ellipse;
  double grey = 0;
  bool inside(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d d = p - ellipse.centre;
    const double c = std::cos(ellipse.angle), s = std::sin(ellipse.angle);
    const double x = (c * d.x() + s * d.y()) / ellipse.a, y = (-s * d.x() + c * d.y()) / ellipse.b;
    return x * x + y * y < 1;
  }
};

/// Renders shapes over a background, later ones on top: area sampling with 8 x 8 samples per pixel, lens blur
/// 0.7 px, Gaussian noise. Positions are rectified; the image is distorted as the camera says.
class SyntheticScene {
 public:
  explicit SyntheticScene(double background) : background_(background) {}
  void add(const ConvexPolygon& p) {
    Shape shape{[p](const Eigen::Vector2d& uv) { return p.inside(uv); }, p.grey, p.corners[0], p.corners[0]};
    for (const Eigen::Vector2d& c : p.corners) {
      shape.low = shape.low.cwiseMin(c);
      shape.high = shape.high.cwiseMax(c);
    }
    shapes_.push_back(shape);
  }
  void add(const FilledEllipse& e) {
    const Eigen::Vector2d r(e.ellipse.a, e.ellipse.a);
    shapes_.push_back({[e](const Eigen::Vector2d& uv) { return e.inside(uv); }, e.grey, e.ellipse.centre - r,
                       e.ellipse.centre + r});
  }

  cv::Mat render(const Camera& camera, double noise, std::mt19937* generator) const {
    constexpr int kSamples = 8;
    cv::Mat image(camera.height, camera.width, CV_32F);
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const auto at = [&](double u, double v) {
          const Eigen::Vector2d uv_raw(x + u, y + v);
          return greyAt(camera.distorted() ? camera.undistort(uv_raw) : uv_raw);
        };
        // A pixel whose middle and corners are alike holds no edge of a convex shape larger than itself.
        double sum = at(0, 0);
        if (at(-.5, -.5) == sum && at(.5, -.5) == sum && at(-.5, .5) == sum && at(.5, .5) == sum) {
          image.at<float>(y, x) = float(sum);
          continue;
        }
        sum = 0;
        for (int j = 0; j < kSamples; ++j)
          for (int i = 0; i < kSamples; ++i)
            sum += at((i + 0.5) / kSamples - 0.5, (j + 0.5) / kSamples - 0.5);
        image.at<float>(y, x) = float(sum / (kSamples * kSamples));
      }

    cv::GaussianBlur(image, image, {0, 0}, 0.7);
    std::normal_distribution<float> normal(0.f, 1.f);
    cv::Mat grey(image.size(), CV_8U);
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x)
        grey.at<uchar>(y, x) =
            cv::saturate_cast<uchar>(image.at<float>(y, x) + float(noise) * normal(*generator));
    return grey;
  }

 private:
  struct Shape {
    std::function<bool(const Eigen::Vector2d&)> inside;
    double grey;
    Eigen::Vector2d low, high;
  };
  double greyAt(const Eigen::Vector2d& p) const {
    for (auto s = shapes_.rbegin(); s != shapes_.rend(); ++s)
      if ((p.array() >= s->low.array()).all() && (p.array() <= s->high.array()).all() && s->inside(p))
        return s->grey;
    return background_;
  }
  double background_;
  std::vector<Shape> shapes_;
};

inline double median(std::vector<double> v) {
  if (v.empty()) return std::nan("");
  std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
  return v[v.size() / 2];
}

/// A grey value at least `contrast` away from another.
inline double otherGrey(std::mt19937* g, double grey, double contrast) {
  double v = grey;
  while (std::fabs(v - grey) < contrast) v = uniform(*g, 10, 245);
  return v;
}

/// A regular polygon with corners moved a little.
inline ConvexPolygon randomPolygon(std::mt19937* g, const Eigen::Vector2d& centre, double radius, int corners,
                                   double grey) {
  ConvexPolygon p;
  p.grey = grey;
  const double turn = uniform(*g, 0, 2 * M_PI);
  for (int i = 0; i < corners; ++i) {
    const double a = turn + 2 * M_PI * (i + uniform(*g, -0.18, 0.18)) / corners;
    p.corners.push_back(centre + radius * Eigen::Vector2d(std::cos(a), std::sin(a)));
  }
  return p;
}

}  // namespace monocular_eye_hand
