#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "monocular_eye_hand/geometry/random.h"
#include "simulation/render/fast_renderer.h"

namespace monocular_eye_hand {
namespace {

constexpr float kSmooth = 0.97f;  // cosine between normals of one smooth surface in neighbouring pixels
constexpr float kStep = 0.0004f;  // step between neighbouring pixels that is an edge [m]
constexpr int kAxis = 4;          // samples per pixel along each axis

}  // namespace

void FastRenderer::findEdges(int first_row, int last_row) {
  const auto apart = [&](int x, int y, int u, int v) {
    const PixelHit &a = hit(x, y), &b = hit(u, v);
    if (a.body != b.body) return true;
    if (a.body < 0) return false;
    return a.normal.dot(b.normal) < kSmooth || std::abs(a.geometric.dot(b.p - a.p)) > kStep;
  };
  for (int y = first_row; y < last_row; ++y)
    for (int x = 0; x < width_; ++x) {
      // Every pixel asks all four neighbours: no row is written by two threads.
      const bool edge = (x > 0 && apart(x, y, x - 1, y)) || (x + 1 < width_ && apart(x, y, x + 1, y)) ||
                        (y > 0 && apart(x, y, x, y - 1)) || (y + 1 < height_ && apart(x, y, x, y + 1));
      edges_(y, x) = edge ? 255 : 0;
    }
}

void FastRenderer::sampleEdges(int first_row, int last_row) {
  for (int y = first_row; y < last_row; ++y)
    for (int x = 0; x < width_; ++x)
      if (edges_(y, x)) image_(y, x) = samplePixel(x, y);
}

float FastRenderer::samplePixel(int x, int y) const {
  InstanceWorld::Rays rays;
  InstanceWorld::Hits hits;
  Eigen::Vector3f directions[kFastLanes];
  float sum = 0;
  const uint32_t key = mixBits(mixBits(key_, uint32_t(x)), uint32_t(y));

  for (int first = 0; first < kAxis * kAxis; first += kFastLanes) {
    for (int k = 0; k < kFastLanes; ++k) {
      const int sample = first + k;
      const uint32_t bits = mixBits(key, uint32_t(sample));
      const int column = sample % kAxis, row = sample / kAxis;
      const float s = (float(column) + float(unitInterval(bits))) / kAxis;
      const float t = (float(row) + float(unitInterval(mixBits(bits)))) / kAxis;
      const Eigen::Vector2f r = ray(x, y, s, t);
      const Eigen::Vector3f d = directions[k] = rayInWorld(r.x(), r.y());
      rays.valid[k] = -1;
      rays.set(k, origin_, d, std::numeric_limits<float>::infinity());
    }

    world_.cast(rays, kFastNear, &hits);
    for (int k = 0; k < kFastLanes; ++k) {
      if (hits.id[k] < 0) {
        sum += shading_.background();
        continue;
      }
      SurfacePoint point{hits.id[k], origin_ + hits.distance[k] * directions[k], {}, hits.normal[k]};
      point.normal = world_.smoothNormal(point.body, hits.triangle[k], hits.u[k], hits.v[k], point.geometric);
      sum += shading_.radiance(point, -directions[k].normalized(), borrowedShares(x, y, point, first + k));
    }
  }
  return sum / float(kAxis * kAxis);
}

/// The light that reaches the nearest pixel of the same surface; asked anew where no neighbour shows it.
LightShares FastRenderer::borrowedShares(int x, int y, const SurfacePoint& point, int sample) const {
  LightShares shares;
  shares.fill(1);
  if (!shadows_) return shares;

  const PixelHit* best = nullptr;
  int best_x = 0, best_y = 0;
  float nearest = 1e9f;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height_ - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width_ - 1); ++u) {
      const PixelHit& other = hit(u, v);
      if (other.body != point.body || other.geometric.dot(point.geometric) < kSmooth) continue;
      const Eigen::Vector3f step = other.p - point.p;
      if (std::abs(step.dot(point.geometric)) > 2 * kStep || step.squaredNorm() >= nearest) continue;
      nearest = step.squaredNorm();
      best = &other;
      best_x = u;
      best_y = v;
    }

  for (int light = 0; light < shading_.lights(); ++light) {
    if (best) {
      shares[size_t(light)] = shares_[size_t(light)](best_y, best_x);
      continue;
    }

    InstanceWorld::Rays rays;
    std::fill(rays.valid, rays.valid + kFastLanes, 0);
    const Eigen::Vector3f p = point.p + kRayLift * point.geometric;
    const int column = sample % kAxis, row = sample / kAxis;
    const Eigen::Vector2f square((float(column) + 0.5f) / kAxis, (float(row) + 0.5f) / kAxis);
    const Eigen::Vector3f to_light = shading_.toLight(light, p, square);
    rays.valid[0] = -1;
    rays.set(0, p, to_light, 1);

    bool blocked[kFastLanes];
    world_.blocked(rays, blocked);
    shares[size_t(light)] = blocked[0] ? 0.0f : 1.0f;
  }
  return shares;
}

}  // namespace monocular_eye_hand
