#include "simulation/render/shader.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/random.h"
#include "simulation/render/texture.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMirrorDimension = 40, kBrushDimension = 41;  // of PixelSampler, beyond those of the lights
constexpr int kMaxLayers = 12;                              // of a translucent object that a ray passes
constexpr float kGrazing = 0.8f;  // share of Fresnel's rise towards grazing angles that rough surfaces show

// An odd number coprime to the count makes k -> (stride k + shift) mod count a permutation.
int coprimeStride(int count, uint32_t bits) {
  static const int kPrimes[] = {11, 13, 17, 19, 23, 29, 31, 37};
  for (uint32_t k = 0; k < 8; ++k) {
    const int prime = kPrimes[(bits + k) % 8];
    if (count % prime != 0) return prime;
  }
  return 1;
}

// Uniform with standard deviation 1.
float spreadOf(double share) { return float(std::sqrt(3.0) * (2 * share - 1)); }

// The mirrored direction, never below the surface.
Eigen::Vector3f reflect(const Eigen::Vector3f& direction, const Eigen::Vector3f& n,
                        const Eigen::Vector3f& flat) {
  const Eigen::Vector3f reflected = direction - 2 * direction.dot(n) * n;
  const float below = reflected.dot(flat);
  return below < 0 ? Eigen::Vector3f((reflected - 2 * below * flat).normalized()) : reflected;
}

float fresnel(double gloss, float cosine) {
  const float rise = std::pow(std::clamp(1 - cosine, 0.0f, 1.0f), 5.0f);
  return float(gloss) + (1 - float(gloss)) * kGrazing * rise;
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
  const int column = cell % per_axis_, row = cell / per_axis_;
  return {(column + unitInterval(jitter)) / per_axis_, (row + unitInterval(mixBits(jitter, 1))) / per_axis_};
}

Shader::Shader(const Scene& scene, const RayWorld& world, const RenderOptions& options)
    : scene_(scene),
      world_(world),
      options_(options),
      lights_(discLights(scene)),
      surroundings_(scene.environment) {
  const auto add = [&](const Material& material, const Rigid3& world_from_object, const Mesh* mesh) {
    Surface surface;
    surface.material = &material;
    surface.object_from_world = world_from_object.inverse();
    if (const Finish* finish = material.finish.get()) {
      surface.prints = PrintLookup(finish->prints, world_from_object);
      if (mesh && (finish->edge_radius > 0 || finish->wear != 0))
        surface.edges = RoundedEdges(*mesh, world_from_object, finish->edge_radius);
      surface.brush_axis = (world_from_object.rotation * finish->brush_axis).cast<float>();
      translucent_ = translucent_ || finish->translucency > 0;
    }
    surfaces_.push_back(std::move(surface));
  };

  for (const SceneObject& object : scene.objects)
    add(object.material, object.world_from_object, object.mesh.get());
  add(scene.table.material, Rigid3{}, nullptr);
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

double Shader::lightShare(const Eigen::Vector3f& p, const DiscLight& light,
                          const Eigen::Vector2d& square) const {
  const Eigen::Vector3f to_light = toDisc(light, square, p);
  const float distance = to_light.norm();
  const Eigen::Vector3f direction = to_light / distance;
  if (!world_.blocked(p, direction, distance)) return 1;
  if (!translucent_) return 0;

  Eigen::Vector3f from = p;
  double share = 1;
  float left = distance;
  for (int layer = 0; layer < kMaxLayers; ++layer) {
    const RayWorld::Hit hit = world_.cast(from, direction);
    if (hit.id == kNothingId || hit.distance > left) return share;
    const Finish* finish = surfaceOf(hit.id).finish();
    if (!finish || finish->translucency <= 0) return 0;
    share *= std::sqrt(finish->translucency);  // in and out again
    from += (hit.distance + kRayLift) * direction;
    left -= hit.distance + kRayLift;
  }
  return 0;
}

void Shader::roundOff(const RayWorld::Hit& hit, const Eigen::Vector3f& at, const Eigen::Vector3f& direction,
                      Point* point) const {
  const Surface& surface = *point->surface;
  const Finish& finish = *surface.finish();
  if (finish.wear != 0) {
    const float near = surface.edges.nearness(hit.triangle, at, float(finish.wear_width));
    if (near > 0) {
      const Texture patches{Texture::Kind::kNoise, 12 * finish.wear_width, 1, 7};
      const double worn =
          finish.wear * near *
          textureFactor(patches, surface.object_from_world * at.cast<double>(), Eigen::Vector3d::UnitZ());
      point->albedo = std::clamp(point->albedo * (1 + worn), 0.0, 1.0);
      point->plain = std::clamp(point->plain * (1 + worn), 0.0, 1.0);
    }
  }

  if (finish.edge_radius <= 0) return;
  const RoundedEdges::Bend bend = surface.edges.bend(hit.triangle, at, point->n);
  if (!bend.bent) return;

  point->n = bend.normal;
  const float away = point->n.dot(direction);
  if (away > 0) point->n = (point->n - away * direction).normalized();
  point->flat = point->n;
  point->to_lights = bend.origin;
}

Shader::Point Shader::pointAt(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                              const RayWorld::Hit& hit) const {
  Point point;
  point.surface = &surfaceOf(hit.id);
  const Eigen::Vector3f at = origin + hit.distance * direction;
  point.n = world_.smoothNormal(hit);
  point.flat = hit.normal;
  point.p = at + kRayLift * hit.normal;
  point.to_lights = point.p;

  const Material& material = *point.surface->material;
  double texture = 1;
  if (material.texture.kind != Texture::Kind::kPlain) {
    const Rigid3& object_from_world = point.surface->object_from_world;
    texture = textureFactor(material.texture, object_from_world * at.cast<double>(),
                            object_from_world.rotation * hit.normal.cast<double>());
  }
  point.albedo = material.albedo * texture;
  point.plain = material.albedo;
  if (!point.surface->finish()) return point;

  const PrintLookup::Ink ink = point.surface->prints.at(float(point.albedo), at, point.n);
  if (ink.bare < 1) {
    point.plain = point.surface->prints.at(float(point.plain), at, point.n).albedo;
    point.albedo = ink.albedo;
    point.bare = ink.bare;
  }
  if (hit.id != kTableId) roundOff(hit, at, direction, &point);
  return point;
}

Illumination<double> Shader::light(const Point& point, const Eigen::Vector3f& geometric,
                                   const Eigen::Vector3f& direction, const PixelSampler& sampler,
                                   int sample) const {
  const Material& material = *point.surface->material;
  Illumination<double> lit{ambientAt(point.p, geometric, sampler.at(sample, 1)), 0};
  if (scene_.sky != 0) lit.diffuse *= std::max(0.0, 1 + scene_.sky * point.n.z());

  const LitPoint to_be_lit{point.p, point.n, point.flat, -direction};
  for (size_t k = 0; k < lights_.size(); ++k) {
    const auto share = [&] {
      return options_.shadows ? lightShare(point.to_lights, lights_[k], sampler.at(sample, 2 + int(k))) : 1;
    };
    addLight(lights_[k], to_be_lit, material, share, &lit);
  }
  return lit;
}

float Shader::seen(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, const RayWorld::Hit& hit,
                   const PixelSampler& sampler, int sample) const {
  const Point point = pointAt(origin, direction, hit);
  const Illumination<double> lit = light(point, hit.normal, direction, sampler, sample);
  const float own = float(point.albedo * lit.diffuse);
  const Finish* finish = point.surface->finish();
  if (!finish || finish->gloss <= 0) return own;

  const float cosine = -direction.dot(point.n);
  const float share = fresnel(finish->gloss * point.bare, cosine);
  const Eigen::Vector3f further = direction + 2 * cosine * point.n;
  return (1 - share) * own + share * surroundings_.radiance(further, float(finish->roughness));
}

float Shader::mirrored(const Point& point, const Eigen::Vector3f& direction, const PixelSampler& sampler,
                       int sample) const {
  const Finish& finish = *point.surface->finish();
  Eigen::Vector3f grooved = point.n;
  if (finish.brushed > 0) {
    // Grooves along the axis throw the light across it.
    const Eigen::Vector3f across = point.surface->brush_axis.cross(point.n);
    grooved += float(finish.brushed) * spreadOf(sampler.at(sample, kBrushDimension).x()) * across;
    grooved.normalize();
  }
  const Eigen::Vector3f x = point.n.unitOrthogonal(), y = point.n.cross(x);
  const Eigen::Vector2d square = sampler.at(sample, kMirrorDimension);
  const float roughness = float(finish.roughness);
  const Eigen::Vector3f rough =
      (grooved + roughness * (spreadOf(square.x()) * x + spreadOf(square.y()) * y)).normalized();

  const Eigen::Vector3f reflected = reflect(direction, rough, point.flat);
  const RayWorld::Hit hit = world_.cast(point.to_lights, reflected);
  if (hit.id != kNothingId) return seen(point.to_lights, reflected, hit, sampler, sample);
  // The surroundings know themselves how a rough surface blurs them: no grain.
  return surroundings_.radiance(reflect(direction, grooved, point.flat), 2 * roughness);
}

float Shader::behind(int object, const Eigen::Vector3f& from, const Eigen::Vector3f& direction,
                     const PixelSampler& sampler, int sample) const {
  Eigen::Vector3f origin = from;
  float share = 1;
  for (int layer = 0; layer < kMaxLayers; ++layer) {
    const RayWorld::Hit hit = world_.cast(origin, direction);
    if (hit.id == kNothingId) return share * float(scene_.background);
    if (hit.id != object) return share * seen(origin, direction, hit, sampler, sample);
    share *= 1 - float(surfaceOf(object).finish()->layer_loss);
    origin += (hit.distance + kRayLift) * direction;
  }
  return 0;
}

Shader::Sample Shader::radiance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                                const PixelSampler& sampler, int sample) const {
  const RayWorld::Hit hit = world_.cast(origin, direction);
  if (hit.id == kNothingId) return {float(scene_.background), float(scene_.background), hit.id};
  const Point point = pointAt(origin, direction, hit);
  const Illumination<double> lit = light(point, hit.normal, direction, sampler, sample);
  const double shine = point.surface->material->specular * lit.highlights;
  double own = point.albedo * lit.diffuse, plain = point.plain * lit.diffuse;

  const Finish* finish = point.surface->finish();
  if (finish && finish->translucency > 0) {
    const Eigen::Vector3f inside = origin + (hit.distance + kRayLift) * direction;
    const double through = finish->translucency * point.bare;
    const double light_behind = behind(hit.id, inside, direction, sampler, sample);
    own += through * (light_behind - own);
    plain += through * (light_behind - plain);
  }
  if (finish && finish->gloss > 0) {
    const double share = fresnel(finish->gloss * point.bare, -direction.dot(point.n));
    const double image = mirrored(point, direction, sampler, sample);
    own += share * (image - own);
    plain += share * (image - plain);
  }
  return {float(own + shine), float(plain + shine), hit.id};
}

}  // namespace monocular_eye_hand
