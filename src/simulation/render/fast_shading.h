#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "simulation/render/disc_light.h"

namespace monocular_eye_hand {

constexpr int kMaxLights = 8;

/// What every light gives to a point: 0 (shadow) to 1.
using LightShares = std::array<float, kMaxLights>;

/// A surface point that is to be shaded; world frame.
struct SurfacePoint {
  int body = -1;
  Eigen::Vector3f p, normal, geometric;  ///< normal: smooth; both unit, towards the eye
};

/// Materials and lights of a world of bodies, shaded in single precision, without what a Finish adds.
class FastShading {
 public:
  /// The table (body `table`, its top in z = 0) has its texture drawn once, on a grid; -1: there is no table.
  FastShading(const Scene& scene, std::vector<Material> materials, int table, int threads);

  void place(const std::vector<Rigid3>& world_from_body);
  int lights() const { return int(lights_.size()); }
  /// From a point of the surface to this point of the light's disc (square: 0..1 twice).
  Eigen::Vector3f toLight(int light, const Eigen::Vector3f& p, const Eigen::Vector2f& square) const;
  /// False when the surface is turned away from the light.
  bool faces(int light, const SurfacePoint& point) const;
  float background() const { return background_; }
  float radiance(const SurfacePoint& point, const Eigen::Vector3f& towards_eye,
                 const LightShares& shares) const;

 private:
  float texture(const SurfacePoint& point) const;
  void drawTable(const Table& table, int threads);

  std::vector<Material> materials_;
  std::vector<Rigid3> body_from_world_;
  float ambient_, background_;
  std::vector<DiscLight> lights_;
  int table_;
  cv::Mat1f table_texture_;  // factor; empty: plain
  Eigen::Vector2f table_corner_;
  float texel_ = 1;
};

}  // namespace monocular_eye_hand
