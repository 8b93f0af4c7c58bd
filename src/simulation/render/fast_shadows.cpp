#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/random.h"
#include "simulation/render/fast_renderer.h"

namespace monocular_eye_hand {
namespace {

// The disc is cut into 4 x 4 cells. A pixel takes one of each quarter, its neighbours the others, so that any
// 2 x 2 pixels see all sixteen. Where in the cell: one of sixteen places.
Eigen::Vector2f discCell(int x, int y, int sample, uint32_t bits) {
  const int column = 2 * (sample & 1) + ((x ^ (sample >> 1)) & 1),
            row = 2 * (sample >> 1) + ((y ^ sample) & 1);
  return {(float(column) + (float(bits >> 28) + 0.5f) / 16) / 4,
          (float(row) + (float((bits >> 24) & 15) + 0.5f) / 16) / 4};
}

}  // namespace

// One ray per pixel and light: enough where all agree and inside wide penumbras, whose grain the mean over
// the neighbourhood takes away. The other three rays are cast where a shadow ends sharply or near an edge of
// a surface.
void FastRenderer::castShadows(int first_row, int last_row) {
  const std::vector<uchar> all(size_t(width_), 255);
  for (int light = 0; light < shading_.lights(); ++light)
    for (int y = first_row; y < last_row; ++y) {
      std::fill_n(lit_[size_t(light)][y], width_, uchar(0));
      for (int x = 0; x < width_; x += kFastLanes) shadowPixels(x, y, light, 0, 1, all.data());
    }
}

void FastRenderer::sortShadows() {
  constexpr float kGrain = 0.6f;  // largest span of the small means inside a wide penumbra
  const cv::Mat five(5, 5, CV_8UC1, cv::Scalar(1)), nine(9, 9, CV_8UC1, cv::Scalar(1));
  const cv::Mat thirteen(13, 13, CV_8UC1, cv::Scalar(1));
  cv::Mat1b near_edge, low, high;
  cv::dilate(edges_, near_edge, thirteen);

  for (int light = 0; light < shading_.lights(); ++light) {
    const cv::Mat1b& lit = lit_[size_t(light)];
    cv::Mat1f mean, min_mean, max_mean;
    cv::boxFilter(lit, mean, CV_32F, {5, 5}, {-1, -1}, true, cv::BORDER_REPLICATE);
    cv::erode(mean, min_mean, nine);
    cv::dilate(mean, max_mean, nine);
    cv::boxFilter(lit, wide_shares_[size_t(light)], CV_32F, {13, 13}, {-1, -1}, true, cv::BORDER_REPLICATE);
    const cv::Mat1b sharp = (max_mean - min_mean > kGrain) | near_edge;
    wide_shares_[size_t(light)].setTo(-1, sharp);

    cv::erode(lit, low, five);
    cv::dilate(lit, high, five);
    mixed_[size_t(light)] = (low != high) & sharp;
    cv::dilate(mixed_[size_t(light)], soft_[size_t(light)], thirteen);
  }
}

void FastRenderer::castMoreShadows(int first_row, int last_row) {
  for (int light = 0; light < shading_.lights(); ++light)
    for (int y = first_row; y < last_row; ++y) {
      const uchar* mixed = mixed_[size_t(light)][y];
      uchar* lit = lit_[size_t(light)][y];
      for (int x = 0; x < width_; ++x)
        if (!mixed[x]) lit[x] = uchar(4 * lit[x]);
      for (int x = 0; x < width_; x += kFastLanes) shadowPixels(x, y, light, 1, 4, mixed);
    }
}

/// Adds the rays that reach the light to lit_, for those of eight pixels that are wanted.
void FastRenderer::shadowPixels(int x, int y, int light, int first_sample, int last_sample,
                                const uchar* wanted) {
  InstanceWorld::Rays rays;
  bool any = false;
  for (int k = 0; k < kFastLanes; ++k) {
    rays.valid[k] = 0;
    if (x + k >= width_ || !wanted[x + k] || hit(x + k, y).body < 0) continue;
    rays.valid[k] = shading_.faces(light, surface(hit(x + k, y))) ? -1 : 0;
    any = any || rays.valid[k];
  }

  for (int step = first_sample; any && step < last_sample; ++step) {
    for (int k = 0; k < kFastLanes; ++k) {
      if (!rays.valid[k]) continue;
      const PixelHit& here = hit(x + k, y);
      // Which quarter comes first differs between neighbours, too: together they see the whole disc.
      const int sample = (step + (x + k) + 2 * y) & 3;

      // The sample's own place in the pixel, on the plane of the pixel's surface.
      const Eigen::Vector2f r = ray(x + k, y, sample & 1 ? 0.75f : 0.25f, sample & 2 ? 0.75f : 0.25f);
      const Eigen::Vector3f d = rayInWorld(r.x(), r.y());
      const float slope = here.geometric.dot(d);
      float depth = std::abs(slope) > 1e-6f ? here.geometric.dot(here.p - origin_) / slope : here.depth;
      depth = std::clamp(depth, 0.98f * here.depth, 1.02f * here.depth);
      const Eigen::Vector3f p = origin_ + depth * d + kRayLift * here.geometric;

      const uint32_t bits = mixBits(key_ + uint32_t(light) + uint32_t(x + k) * 0x9e3779b9u +
                                    uint32_t(4 * y + sample) * 0x85ebca6bu);
      const Eigen::Vector3f to_light = shading_.toLight(light, p, discCell(x + k, y, sample, bits));
      rays.set(k, p, to_light, 1);
    }

    bool blocked[kFastLanes] = {};
    world_.blocked(rays, blocked);
    for (int k = 0; k < kFastLanes; ++k)
      if (rays.valid[k] && !blocked[k]) ++lit_[size_t(light)](y, x + k);
  }
}

void FastRenderer::smoothShadows(int first_row, int last_row) {
  for (int light = 0; light < shading_.lights(); ++light)
    for (int y = first_row; y < last_row; ++y)
      for (int x = 0; x < width_; ++x) near_shares_[size_t(light)](y, x) = nearShare(x, y, light);
}

float FastRenderer::nearShare(int x, int y, int light) const {
  const cv::Mat1b& lit = lit_[size_t(light)];
  if (!mixed_[size_t(light)](y, x)) return float(lit(y, x)) / 4;
  const PixelHit& here = hit(x, y);
  const int left = std::max(x - 1, 0), right = std::min(x + 1, width_ - 1);
  const int above = std::max(y - 1, 0), below = std::min(y + 1, height_ - 1);
  // 1 2 1 both ways gives every pixel of the 2 x 2 pattern the same weight.
  int sum = 0, weight = 0;
  for (int v = above; v <= below; ++v)
    for (int u = left; u <= right; ++u) {
      if (!sameSurface(here, hit(u, v))) continue;
      const int w = (2 - std::abs(u - x)) * (2 - std::abs(v - y));
      sum += w * lit(v, u);
      weight += w;
    }
  return float(sum) / float(4 * weight);
}

// Where a penumbra is wide its sixteen samples still show as grain: there the mean over a wider neighbourhood
// stands for it. Where it is narrow the neighbourhood spans more than grain, and the pixel keeps its own.
float FastRenderer::lightShare(int x, int y, int light) const {
  constexpr int kReach = 6, kStride = 3;
  constexpr float kGrain = 0.65f;
  const cv::Mat1f& shares = near_shares_[size_t(light)];
  const float own = shares(y, x), wide = wide_shares_[size_t(light)](y, x);
  if (wide >= 0) return wide;
  if (!soft_[size_t(light)](y, x)) return own;

  const PixelHit& here = hit(x, y);
  float sum = 0, low = 1, high = 0;
  int count = 0;
  for (int v = y - kReach; v <= y + kReach; v += kStride) {
    if (v < 0 || v >= height_) continue;
    for (int u = x - kReach; u <= x + kReach; u += kStride) {
      if (u < 0 || u >= width_ || !sameSurface(here, hit(u, v))) continue;
      const float share = shares(v, u);
      low = std::min(low, share);
      high = std::max(high, share);
      if (high - low > kGrain) return own;
      sum += share;
      ++count;
    }
  }
  return sum / float(count);
}

}  // namespace monocular_eye_hand
