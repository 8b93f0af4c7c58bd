#include "simulation/render/fast_renderer.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "simulation/render/parallel_rows.h"

namespace monocular_eye_hand {
namespace {}  // namespace

FastRenderer::FastRenderer(const Camera& camera, const InstanceWorld& world, const FastShading& shading,
                           bool shadows, int threads)
    : world_(world),
      shading_(shading),
      width_(camera.width),
      height_(camera.height),
      threads_(threads),
      shadows_(shadows),
      hits_(size_t(camera.width) * size_t(camera.height)),
      edges_(camera.height, camera.width),
      image_(camera.height, camera.width) {
  for (int y = 0; y <= height_; ++y)
    for (int x = 0; x <= width_; ++x) {
      const Eigen::Vector2d uv = camera.undistort({x - 0.5, y - 0.5});
      corner_rays_.push_back(camera.ray(uv).head<2>().cast<float>());
    }
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) centre_rays_.push_back(ray(x, y, 0.5f, 0.5f));

  for (int k = 0; k < shading.lights(); ++k) {
    lit_.emplace_back(height_, width_);
    mixed_.emplace_back(height_, width_);
    soft_.emplace_back(height_, width_);
    wide_shares_.emplace_back(height_, width_);
    near_shares_.emplace_back(height_, width_);
    shares_.emplace_back(height_, width_);
  }
}

Eigen::Vector2f FastRenderer::ray(int x, int y, float s, float t) const {
  const Eigen::Vector2f* corner = &corner_rays_[size_t(y) * size_t(width_ + 1) + size_t(x)];
  const Eigen::Vector2f* below = corner + width_ + 1;
  return (1 - t) * ((1 - s) * corner[0] + s * corner[1]) + t * ((1 - s) * below[0] + s * below[1]);
}

void FastRenderer::findHits(int first_row, int last_row) {
  InstanceWorld::Rays rays;
  InstanceWorld::Hits hits;
  for (int y = first_row; y < last_row; ++y)
    for (int x = 0; x < width_; x += kFastLanes) {
      for (int k = 0; k < kFastLanes; ++k) {
        rays.valid[k] = x + k < width_ ? -1 : 0;
        const Eigen::Vector2f r = centreRay(std::min(x + k, width_ - 1), y);
        const Eigen::Vector3f d = rayInWorld(r.x(), r.y());
        rays.set(k, origin_, d, std::numeric_limits<float>::infinity());
      }

      world_.cast(rays, kFastNear, &hits);
      for (int k = 0; k < kFastLanes && x + k < width_; ++k) {
        PixelHit& out = hit(x + k, y);
        out.body = hits.id[k];
        out.depth = out.body >= 0 ? hits.distance[k] : 0;
        if (out.body < 0) continue;
        out.p = origin_ + out.depth * Eigen::Vector3f(rays.dx[k], rays.dy[k], rays.dz[k]);
        out.geometric = hits.normal[k];
        out.normal = world_.smoothNormal(out.body, hits.triangle[k], hits.u[k], hits.v[k], out.geometric);
      }
    }
}

void FastRenderer::shade(int first_row, int last_row) {
  LightShares shares;
  for (int y = first_row; y < last_row; ++y)
    for (int x = 0; x < width_; ++x) {
      const PixelHit& here = hit(x, y);
      if (here.body < 0) {
        image_(y, x) = shading_.background();
        continue;
      }
      for (int k = 0; k < shading_.lights(); ++k)
        shares[size_t(k)] = shares_[size_t(k)](y, x) = shadows_ ? lightShare(x, y, k) : 1.0f;
      image_(y, x) = shading_.radiance(surface(here), (origin_ - here.p).normalized(), shares);
    }
}

const cv::Mat1f& FastRenderer::render(const Rigid3& world_from_camera, uint32_t key) {
  rotation_ = world_from_camera.rotation.cast<float>();
  origin_ = world_from_camera.translation.cast<float>();
  key_ = key;
  parallelRows(threads_, height_, [&](int a, int b) { findHits(a, b); });
  parallelRows(threads_, height_, [&](int a, int b) { findEdges(a, b); });
  if (shadows_) {
    parallelRows(threads_, height_, [&](int a, int b) { castShadows(a, b); });
    sortShadows();
    parallelRows(threads_, height_, [&](int a, int b) { castMoreShadows(a, b); });
    parallelRows(threads_, height_, [&](int a, int b) { smoothShadows(a, b); });
  }
  parallelRows(threads_, height_, [&](int a, int b) { shade(a, b); });
  parallelRows(threads_, height_, [&](int a, int b) { sampleEdges(a, b); });
  return image_;
}

cv::Mat FastRenderer::bodies() const {
  cv::Mat1s out(height_, width_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) out(y, x) = short(hit(x, y).body);
  return out;
}

cv::Mat FastRenderer::depth() const {
  cv::Mat1f out(height_, width_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) out(y, x) = hit(x, y).depth;
  return out;
}

}  // namespace monocular_eye_hand
