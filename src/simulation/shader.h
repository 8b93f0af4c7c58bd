#pragma once
#include "monocular_eye_hand/simulation/render.h"
#include "ray_world.h"

namespace monocular_eye_hand {

/// Points of a sample in the unit square, stratified over the samples of a pixel in every dimension.
class PixelSampler {
 public:
  PixelSampler(uint32_t seed, int x, int y, int per_axis);
  Eigen::Vector2d at(int sample, int dimension) const;
  int count() const { return per_axis_ * per_axis_; }

 private:
  uint32_t key_;
  int per_axis_, stride_;
};

/// Radiance along a ray: Lambert and Blinn-Phong under disc lights, ambient light.
class Shader {
 public:
  Shader(const Scene& scene, const RayWorld& world, const RenderOptions& options);
  struct Sample {
    float radiance;
    int id;
  };
  Sample radiance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                  const PixelSampler& sampler, int sample) const;

 private:
  double ambientAt(const Eigen::Vector3f& p, const Eigen::Vector3f& n, const Eigen::Vector2d& square) const;

  const Scene& scene_;
  const RayWorld& world_;
  const RenderOptions& options_;
  struct LightFrame {
    Eigen::Vector3f centre, x, y;  // x, y span the disc, length = radius
  };
  std::vector<LightFrame> lights_;
  std::vector<Rigid3> object_from_world_;
};

}  // namespace monocular_eye_hand
