#include "shader.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "random.h"
#include "texture.h"

namespace monocular_eye_hand {
namespace {

constexpr float kLift = 2e-5f;  // secondary rays start this far above the surface [m]

// An odd number coprime to the count makes k -> (stride k + shift) mod count a permutation.
int coprimeStride(int count, uint32_t bits) {
  static const int kPrimes[] = {11, 13, 17, 19, 23, 29, 31, 37};
  for (uint32_t k = 0; k < 8; ++k) {
    const int prime = kPrimes[(bits + k) % 8];
    if (count % prime != 0) return prime;
  }
  return 1;
}

}  // namespace

PixelSampler::PixelSampler(uint32_t seed, int x, int y, int per_axis)
    : key_(mixBits(mixBits(seed, uint32_t(x)), uint32_t(y))),
      per_axis_(per_axis),
      stride_(coprimeStride(per_axis * per_axis, key_)) {}

Eigen::Vector2d PixelSampler::at(int sample, int dimension) const {
  const uint32_t bits = mixBits(key_, uint32_t(dimension));
  const int cell = dimension == 0 ? sample : (stride_ * sample + int(bits % 977)) % count();
  const uint32_t jitter = mixBits(bits, uint32_t(sample));
  return {(cell % per_axis_ + unitInterval(jitter)) / per_axis_,
          (cell / per_axis_ + unitInterval(mixBits(jitter, 1))) / per_axis_};
}

Shader::Shader(const Scene& scene, const RayWorld& world, const RenderOptions& options)
    : scene_(scene), world_(world), options_(options) {
  for (const Light& light : scene.lights) {
    const Eigen::Vector3d axis = -light.position.normalized();
    const Eigen::Vector3d x = axis.unitOrthogonal();
    lights_.push_back({light.position.cast<float>(), (light.radius * x).cast<float>(),
                       (light.radius * axis.cross(x)).cast<float>()});
  }
  for (const SceneObject& object : scene.objects)
    object_from_world_.push_back(object.world_from_object.inverse());
}

double Shader::ambientAt(const Eigen::Vector3f& p, const Eigen::Vector3f& n,
                         const Eigen::Vector2d& square) const {
  if (!options_.ambient_occlusion) return scene_.ambient;
  const double r = std::sqrt(square.x()), angle = 2 * M_PI * square.y();  // cosine-weighted direction
  const Eigen::Vector3f x = n.unitOrthogonal(), y = n.cross(x);
  const Eigen::Vector3f direction = float(r * std::cos(angle)) * x + float(r * std::sin(angle)) * y +
                                    float(std::sqrt(std::max(0.0, 1 - square.x()))) * n;
  return world_.blocked(p, direction, float(options_.occlusion_range)) ? 0 : scene_.ambient;
}

bool Shader::shadowed(const Eigen::Vector3f& p, const LightFrame& light,
                      const Eigen::Vector2d& square) const {
  const Eigen::Vector2d disc = discPoint(square);
  const Eigen::Vector3f to_light = light.centre + float(disc.x()) * light.x + float(disc.y()) * light.y - p;
  const float distance = to_light.norm();
  return world_.blocked(p, to_light / distance, distance);
}

Shader::Sample Shader::radiance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                                const PixelSampler& sampler, int sample) const {
  const RayWorld::Hit hit = world_.cast(origin, direction);
  if (hit.id == kNothingId) return {float(scene_.background), float(scene_.background), hit.id};
  const Eigen::Vector3f n = world_.smoothNormal(hit);
  const Eigen::Vector3f surface = origin + hit.distance * direction;
  const Eigen::Vector3f p = surface + kLift * hit.normal;
  const bool table = hit.id == kTableId;
  const Material& material = table ? scene_.table.material : scene_.objects[hit.id].material;
  const double albedo = material.albedo;
  double texture = 1;
  if (material.texture.kind != Texture::Kind::kPlain) {
    const Rigid3 object_from_world = table ? Rigid3{} : object_from_world_[hit.id];
    texture = textureFactor(material.texture, object_from_world * surface.cast<double>(),
                            object_from_world.rotation * hit.normal.cast<double>());
  }
  double diffuse = ambientAt(p, hit.normal, sampler.at(sample, 1)), highlights = 0;
  for (size_t k = 0; k < lights_.size(); ++k) {
    // The disc's middle gives the amount of light, a sampled point of it the shadow: smooth where nothing is
    // hidden.
    Eigen::Vector3f to_light = lights_[k].centre - p;
    const float square_distance = to_light.squaredNorm();
    to_light /= std::sqrt(square_distance);
    const float cosine = n.dot(to_light);
    if (cosine <= 0 || hit.normal.dot(to_light) <= 0) continue;
    if (options_.shadows && shadowed(p, lights_[k], sampler.at(sample, 2 + int(k)))) continue;
    const double irradiance = scene_.lights[k].intensity / square_distance * cosine;
    diffuse += irradiance;
    highlights += irradiance * highlight(material, n.dot((to_light - direction).normalized()));
  }
  const double shine = material.specular * highlights;
  return {float(albedo * texture * diffuse + shine), float(albedo * diffuse + shine), hit.id};
}

}  // namespace monocular_eye_hand
