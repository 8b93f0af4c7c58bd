#pragma once
#include "monocular_eye_hand/simulation/render/rendered_image.h"
#include "simulation/render/disc_light.h"
#include "simulation/render/environment.h"
#include "simulation/render/print_lookup.h"
#include "simulation/render/ray_world.h"
#include "simulation/render/rounded_edges.h"

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

/// Radiance along a ray: Lambert and Blinn-Phong under disc lights, ambient light, and what a Finish adds:
/// prints, worn and rounded edges, one mirrored ray, what lies behind translucent things.
class Shader {
 public:
  Shader(const Scene& scene, const RayWorld& world, const RenderOptions& options);
  struct Sample {
    float radiance;
    float plain;  ///< the same without the texture
    int id;
  };
  Sample radiance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                  const PixelSampler& sampler, int sample) const;

 private:
  /// What of an object or the table depends on its finish.
  struct Surface {
    const Material* material;
    Rigid3 object_from_world;
    PrintLookup prints;
    RoundedEdges edges;
    Eigen::Vector3f brush_axis;  // world
    const Finish* finish() const { return material->finish.get(); }
  };
  /// A point to be lit, world frame.
  struct Point {
    const Surface* surface;
    Eigen::Vector3f p;          // slightly above the surface
    Eigen::Vector3f to_lights;  // where rays to the lights start
    Eigen::Vector3f n, flat;    // shading normal, and the one that decides which side faces a light
    double albedo, plain;       // with and without texture
    double bare = 1;            // share without print
  };
  Point pointAt(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                const RayWorld::Hit& hit) const;
  void roundOff(const RayWorld::Hit& hit, const Eigen::Vector3f& at, const Eigen::Vector3f& direction,
                Point* point) const;
  Illumination<double> light(const Point& point, const Eigen::Vector3f& geometric,
                             const Eigen::Vector3f& direction, const PixelSampler& sampler, int sample) const;
  /// Diffuse light along a further ray, that has met `hit`.
  float seen(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, const RayWorld::Hit& hit,
             const PixelSampler& sampler, int sample) const;
  float mirrored(const Point& point, const Eigen::Vector3f& direction, const PixelSampler& sampler,
                 int sample) const;
  float behind(int object, const Eigen::Vector3f& from, const Eigen::Vector3f& direction,
               const PixelSampler& sampler, int sample) const;
  /// 0 in the shadow, 1 in the light.
  double lightShare(const Eigen::Vector3f& p, const DiscLight& light, const Eigen::Vector2d& square) const;
  double ambientAt(const Eigen::Vector3f& p, const Eigen::Vector3f& n, const Eigen::Vector2d& square) const;
  const Surface& surfaceOf(int id) const { return id == kTableId ? surfaces_.back() : surfaces_[size_t(id)]; }

  const Scene& scene_;
  const RayWorld& world_;
  const RenderOptions& options_;
  std::vector<DiscLight> lights_;
  std::vector<Surface> surfaces_;  // one per object, the table last
  Surroundings surroundings_;
  bool translucent_ = false;  // something lets light through
};

}  // namespace monocular_eye_hand
