#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "simulation/render/fast_shading.h"
#include "simulation/render/instance_world.h"

namespace monocular_eye_hand {

inline constexpr int kFastLanes = InstanceWorld::kLanes;  // rays that are cast together
inline constexpr float kFastNear = 0.01f;                 // nothing is seen nearer to the lens [m]

/// One picture of a world of bodies, in passes over bands of rows: first hits, shadows, their smoothing,
/// shading, finer sampling of pixels where surfaces meet.
class FastRenderer {
 public:
  FastRenderer(const Camera& camera, const InstanceWorld& world, const FastShading& shading, bool shadows,
               int threads);
  /// Linear radiance. `key` seeds the places of the shadow samples.
  const cv::Mat1f& render(const Rigid3& world_from_camera, uint32_t key);
  /// Of the last picture, at pixel centres: body or -1; z in the camera frame, 0 where nothing is.
  cv::Mat bodies() const;
  cv::Mat depth() const;

 private:
  struct PixelHit {
    Eigen::Vector3f p, normal, geometric;  // world
    float depth = 0;
    int body = -1;
  };
  Eigen::Vector3f rayInWorld(float x, float y) const { return rotation_ * Eigen::Vector3f(x, y, 1); }
  /// Camera-frame ray through a pixel at (s, t) of its square, bilinear in its corners' rays.
  Eigen::Vector2f ray(int x, int y, float s, float t) const;
  Eigen::Vector2f centreRay(int x, int y) const {
    return centre_rays_[size_t(y) * size_t(width_) + size_t(x)];
  }
  PixelHit& hit(int x, int y) { return hits_[size_t(y) * size_t(width_) + size_t(x)]; }
  const PixelHit& hit(int x, int y) const { return hits_[size_t(y) * size_t(width_) + size_t(x)]; }
  static SurfacePoint surface(const PixelHit& hit) { return {hit.body, hit.p, hit.normal, hit.geometric}; }

  void findHits(int first_row, int last_row);
  void castShadows(int first_row, int last_row);
  void sortShadows();
  void castMoreShadows(int first_row, int last_row);
  void shadowPixels(int x, int y, int light, int first_sample, int last_sample, const uchar* wanted);
  void shade(int first_row, int last_row);
  void smoothShadows(int first_row, int last_row);
  float nearShare(int x, int y, int light) const;
  float lightShare(int x, int y, int light) const;
  void findEdges(int first_row, int last_row);
  void sampleEdges(int first_row, int last_row);
  float samplePixel(int x, int y) const;
  LightShares borrowedShares(int x, int y, const SurfacePoint& point, int sample) const;
  static bool sameSurface(const PixelHit& a, const PixelHit& b) {
    return a.body == b.body && (a.body < 0 || a.geometric.dot(b.geometric) > 0.9f);
  }

  const InstanceWorld& world_;
  const FastShading& shading_;
  int width_, height_, threads_;
  bool shadows_;
  std::vector<Eigen::Vector2f> corner_rays_, centre_rays_;
  Eigen::Matrix3f rotation_;
  Eigen::Vector3f origin_;
  uint32_t key_ = 0;
  std::vector<PixelHit> hits_;
  std::vector<cv::Mat1b> lit_;          // per light: shadow rays out of four that reach it
  std::vector<cv::Mat1b> mixed_;        // 255: all four rays are cast
  std::vector<cv::Mat1b> soft_;         // 255: such a pixel is near
  std::vector<cv::Mat1f> wide_shares_;  // mean over a wide neighbourhood; -1: does not stand for the pixel
  std::vector<cv::Mat1f> near_shares_;  // the same, over the nearest pixels
  std::vector<cv::Mat1f> shares_;       // the same, smoothed
  cv::Mat1b edges_;
  cv::Mat1f image_;
};

}  // namespace monocular_eye_hand
