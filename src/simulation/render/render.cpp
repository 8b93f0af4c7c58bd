#include "monocular_eye_hand/simulation/render/render.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"
#include "simulation/render/sensor.h"
#include "simulation/render/shader.h"
#include "simulation/render/visibility.h"

namespace monocular_eye_hand {
namespace {

constexpr float kSpread = 0.06f;        // relative difference of samples that asks for more of them
constexpr float kTextureSpread = 0.2f;  // the same with texture, where a pixel has one sample only

bool differ(float a, float b, float spread = kSpread) {
  return std::abs(a - b) > spread * (0.5f * (a + b) + 0.02f);
}

}  // namespace

void RenderOptions::check() const {
  require(samples >= 1 && samples <= 16, "samples", samples, "1..16");
  require(edge_samples >= samples && edge_samples <= 16, "edge_samples", edge_samples, "samples..16");
  require(occlusion_range > 0, "occlusion_range", occlusion_range, "positive");
  require(blur_sigma >= 0 && blur_sigma < 20, "blur_sigma", blur_sigma, "0..20 px");
  require(noise_sigma >= 0 && noise_sigma < 100, "noise_sigma", noise_sigma, "0..100 grey levels");
  require(shot_noise >= 0 && shot_noise < 10, "shot_noise", shot_noise, "0..10");
  require(exposure >= 0 && std::isfinite(exposure), "exposure", exposure, ">= 0 (0: automatic)");
  require(mean > 0 && mean < 1, "mean", mean, "between 0 and 1");
  require(saturated >= 0 && saturated < 1, "saturated", saturated, "0..1");
  require(vignetting >= 0 && vignetting < 1, "vignetting", vignetting, "0..1");
  require(sharpening >= 0 && sharpening <= 5, "sharpening", sharpening, "0..5");
  require(gamma > 0.1 && gamma < 10, "gamma", gamma, "0.1..10");
}

namespace {

/// Rays of one camera in the world; distortion by a grid at the pixels' corners (bilinear: below 0.001 px).
class CameraRays {
 public:
  CameraRays(const Camera& camera, const Rigid3& world_from_camera)
      : camera_(camera),
        rotation_(world_from_camera.rotation),
        origin_(world_from_camera.translation.cast<float>()) {
    if (!camera.distorted()) return;
    grid_.create(camera.height + 1, camera.width + 1);
    for (int y = 0; y <= camera.height; ++y)
      for (int x = 0; x <= camera.width; ++x) {
        const Eigen::Vector2d uv = camera.undistort({x - 0.5, y - 0.5});
        grid_(y, x) = {uv.x(), uv.y()};
      }
  }
  const Eigen::Vector3f& origin() const { return origin_; }
  /// Unit direction through pixel (x, y), at (square - 0.5) from its centre.
  Eigen::Vector3f direction(int x, int y, const Eigen::Vector2d& square) const {
    Eigen::Vector2d uv(x - 0.5 + square.x(), y - 0.5 + square.y());
    if (!grid_.empty()) {
      const double s = square.x(), t = square.y();
      const cv::Vec2d mixed = (1 - t) * ((1 - s) * grid_(y, x) + s * grid_(y, x + 1)) +
                              t * ((1 - s) * grid_(y + 1, x) + s * grid_(y + 1, x + 1));
      uv = {mixed[0], mixed[1]};
    }
    return (rotation_ * camera_.ray(uv)).normalized().cast<float>();
  }

 private:
  const Camera& camera_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3f origin_;
  cv::Mat_<cv::Vec2d> grid_;
};

struct Pixel {
  float mean = 0;
  float plain = 0;     // mean without texture: what asks for more samples
  bool mixed = false;  // its samples differ
  int id = kNothingId;
};

Pixel samplePixel(const Shader& shader, const CameraRays& rays, int x, int y, int per_axis, uint32_t seed) {
  const PixelSampler sampler(seed, x, y, per_axis);
  Pixel pixel;
  float sum = 0, plain = 0, low = 0, high = 0;
  for (int k = 0; k < sampler.count(); ++k) {
    const Shader::Sample s =
        shader.radiance(rays.origin(), rays.direction(x, y, sampler.at(k, 0)), sampler, k);
    if (k == 0) {
      pixel.id = s.id;
      low = high = s.plain;
    }
    pixel.mixed = pixel.mixed || s.id != pixel.id;
    low = std::min(low, s.plain);
    high = std::max(high, s.plain);
    sum += s.radiance;
    plain += s.plain;
  }

  pixel.mean = sum / float(sampler.count());
  pixel.plain = plain / float(sampler.count());
  pixel.mixed = pixel.mixed || differ(low, high);
  return pixel;
}

// Pixels that need more samples: mixed ones, those that differ from a neighbour, and their neighbours. Taking
// the neighbours in keeps the mean unbiased: a thin sliver that all first samples missed is still sampled
// finely.
cv::Mat1b roughPixels(const std::vector<Pixel>& pixels, int width, int height, bool single) {
  cv::Mat1b rough(height, width, uchar(0));
  const auto unlike = [&](const Pixel& a, const Pixel& b) {
    return a.id != b.id || differ(a.plain, b.plain) || (single && differ(a.mean, b.mean, kTextureSpread));
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Pixel& here = pixels[size_t(y) * width + x];
      if (here.mixed) rough(y, x) = 255;
      if (x + 1 < width && unlike(here, pixels[size_t(y) * width + x + 1]))
        rough(y, x) = rough(y, x + 1) = 255;
      if (y + 1 < height && unlike(here, pixels[size_t(y + 1) * width + x]))
        rough(y, x) = rough(y + 1, x) = 255;
    }
  cv::dilate(rough, rough, cv::Mat());
  return rough;
}

cv::Mat1f radianceImage(const Shader& shader, const CameraRays& rays, const Camera& camera,
                        const RenderOptions& options) {
  const int w = camera.width, h = camera.height;
  std::vector<Pixel> pixels(size_t(w) * h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      pixels[size_t(y) * w + x] = samplePixel(shader, rays, x, y, options.samples, options.seed);
  cv::Mat1f image(h, w);
  const bool refine = options.edge_samples > options.samples;
  const cv::Mat1b rough =
      refine ? roughPixels(pixels, w, h, options.samples == 1) : cv::Mat1b(h, w, uchar(0));
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      image(y, x) = rough(y, x) ? samplePixel(shader, rays, x, y, options.edge_samples, options.seed).mean
                                : pixels[size_t(y) * w + x].mean;
  return image;
}

void centreMaps(const RayWorld& world, const CameraRays& rays, const Camera& camera,
                const Rigid3& world_from_camera, RenderedImage* out) {
  out->ids.create(camera.height, camera.width, CV_16SC1);
  out->depth.create(camera.height, camera.width, CV_32FC1);
  const Eigen::Vector3f axis = world_from_camera.rotation.col(2).cast<float>();
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3f direction = rays.direction(x, y, {0.5, 0.5});
      const RayWorld::Hit hit = world.cast(rays.origin(), direction);
      out->ids.at<short>(y, x) = short(hit.id);
      out->depth.at<float>(y, x) = hit.distance * direction.dot(axis);
    }
}

}  // namespace

RenderedImage renderScene(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  camera.check();
  options.check();
  if (!scene.world_from_camera.isFinite()) throw BadInput("scene: world_from_camera is not finite");
  const RayWorld world(scene);
  const CameraRays rays(camera, scene.world_from_camera);
  const Shader shader(scene, world, options);
  RenderedImage out;
  const cv::Mat1f radiance = radianceImage(shader, rays, camera, options);
  out.grey = sensorImage(radiance, options, &out.exposure);
  centreMaps(world, rays, camera, scene.world_from_camera, &out);
  out.objects = visibility(scene, world, camera, out.ids);
  return out;
}

}  // namespace monocular_eye_hand
