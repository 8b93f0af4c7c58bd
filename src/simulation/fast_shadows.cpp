#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fast_renderer.h"
#include "random.h"

namespace monocular_eye_hand {
namespace {

constexpr float kLift = 2e-5f;  // shadow rays start this far above the surface [m]
constexpr int kLanes = InstanceWorld::kLanes;

// The disc is cut into 4 x 4 cells. A pixel takes one of each quarter, its neighbours the others, so that any
// 2 x 2 pixels see all sixteen.
Eigen::Vector2f discCell(int x, int y, int sample, uint32_t bits) {
  const int column = 2 * (sample & 1) + ((x ^ (sample >> 1)) & 1),
            row = 2 * (sample >> 1) + ((y ^ sample) & 1);
  return {(float(column) + float(unitInterval(bits))) / 4,
          (float(row) + float(unitInterval(mixBits(bits)))) / 4};
}

}  // namespace

void FastRenderer::castShadows(int first_row, int last_row) {
  for (int light = 0; light < look_.lights(); ++light)
    for (int y = first_row; y < last_row; ++y)
      for (int x = 0; x < width_; x += kLanes) shadowPixels(x, y, light);
}

void FastRenderer::shadowPixels(int x, int y, int light) {
  const int count = std::min(kLanes, width_ - x);
  SurfacePoint points[kLanes];
  InstanceWorld::Rays rays;
  bool any = false;
  int lit[kLanes] = {};
  for (int k = 0; k < kLanes; ++k) {
    rays.valid[k] = 0;
    if (k >= count || hit(x + k, y).body < 0) continue;
    const Eigen::Vector2f r = centreRay(x + k, y);
    points[k] = surface(hit(x + k, y), rayInWorld(r.x(), r.y()));
    rays.valid[k] = look_.faces(light, points[k]) ? -1 : 0;
    any = any || rays.valid[k];
  }
  for (int sample = 0; any && sample < 4; ++sample) {
    for (int k = 0; k < kLanes; ++k) {
      if (!rays.valid[k]) continue;
      // The sample's own place in the pixel, on the plane of the pixel's surface.
      const PixelHit& here = hit(x + k, y);
      const Eigen::Vector2f r = ray(x + k, y, sample & 1 ? 0.75f : 0.25f, sample & 2 ? 0.75f : 0.25f);
      const Eigen::Vector3f d = rayInWorld(r.x(), r.y());
      const float slope = here.geometric.dot(d);
      float depth = std::abs(slope) > 1e-6f ? here.geometric.dot(points[k].p - origin_) / slope : here.depth;
      depth = std::clamp(depth, 0.98f * here.depth, 1.02f * here.depth);
      const Eigen::Vector3f p = origin_ + depth * d + kLift * here.geometric;
      const uint32_t bits =
          mixBits(mixBits(key_ + uint32_t(light), uint32_t(x + k)), uint32_t(4 * y + sample));
      const Eigen::Vector3f to_light = look_.toLight(light, p, discCell(x + k, y, sample, bits));
      rays.ox[k] = p.x(), rays.oy[k] = p.y(), rays.oz[k] = p.z();
      rays.dx[k] = to_light.x(), rays.dy[k] = to_light.y(), rays.dz[k] = to_light.z();
      rays.far[k] = 1;
    }
    bool blocked[kLanes];
    world_.blocked(rays, blocked);
    for (int k = 0; k < kLanes; ++k) lit[k] += rays.valid[k] && !blocked[k];
  }
  for (int k = 0; k < count; ++k) lit_[size_t(light)](y, x + k) = uchar(lit[k]);
}

float FastRenderer::lightShare(int x, int y, int light) const {
  const cv::Mat1b& lit = lit_[size_t(light)];
  const PixelHit& here = hit(x, y);
  const int own = lit(y, x);
  const int left = std::max(x - 1, 0), right = std::min(x + 1, width_ - 1);
  const int above = std::max(y - 1, 0), below = std::min(y + 1, height_ - 1);
  bool equal = true;
  for (int v = above; v <= below; ++v)
    for (int u = left; u <= right; ++u) equal = equal && lit(v, u) == own;
  if (equal) return float(own) / 4;
  // 1 2 1 both ways gives every pixel of the 2 x 2 pattern the same weight.
  int sum = 0, weight = 0;
  for (int v = above; v <= below; ++v)
    for (int u = left; u <= right; ++u) {
      if (!sameSurface(here, hit(u, v))) continue;
      const int w = (2 - std::abs(u - x)) * (2 - std::abs(v - y));
      sum += w * lit(v, u), weight += w;
    }
  return float(sum) / float(4 * weight);
}

}  // namespace monocular_eye_hand
