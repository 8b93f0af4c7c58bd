#include "simulation/fast_look.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "simulation/parallel_rows.h"
#include "simulation/shader.h"
#include "simulation/texture.h"

namespace monocular_eye_hand {
namespace {

constexpr double kTexel = 0.0005;  // finest grid of the table's texture [m]
constexpr double kMostTexels = 6e6;

}  // namespace

FastLook::FastLook(const Scene& scene, std::vector<Material> materials, int table, int threads)
    : materials_(std::move(materials)),
      ambient_(float(scene.ambient)),
      background_(float(scene.background)),
      table_(table) {
  if (scene.lights.size() > size_t(kMostLights))
    throw BadInput("lights: " + std::to_string(scene.lights.size()) + " given, at most " +
                   std::to_string(kMostLights) + " possible");
  for (const Light& light : scene.lights) {
    const Eigen::Vector3d axis = -light.position.normalized();
    const Eigen::Vector3d x = axis.unitOrthogonal();
    lights_.push_back({light.position.cast<float>(), (light.radius * x).cast<float>(),
                       (light.radius * axis.cross(x)).cast<float>(), float(light.intensity)});
  }
  if (table_ >= 0 && scene.table.material.texture.kind != Texture::Kind::kPlain)
    drawTable(scene.table, threads);
}

void FastLook::drawTable(const Table& table, int threads) {
  const double length = 2 * table.half_width, width = 2 * table.half_depth;
  const double texel = std::max(kTexel, std::sqrt(length * width / kMostTexels));
  table_texture_.create(int(std::ceil(width / texel)) + 2, int(std::ceil(length / texel)) + 2);
  texel_ = float(texel);
  table_corner_ = {float(-table.half_width), float(-table.half_depth)};
  parallelRows(threads, table_texture_.rows, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < table_texture_.cols; ++x)
        table_texture_(y, x) = float(textureFactor(
            table.material.texture, {x * texel - table.half_width, y * texel - table.half_depth, 0},
            Eigen::Vector3d::UnitZ()));
  });
}

void FastLook::place(const std::vector<Rigid3>& world_from_body) {
  body_from_world_.clear();
  for (const Rigid3& pose : world_from_body) body_from_world_.push_back(pose.inverse());
}

Eigen::Vector3f FastLook::toLight(int light, const Eigen::Vector3f& p, const Eigen::Vector2f& square) const {
  const float u = 2 * square.x() - 1, v = 2 * square.y() - 1;  // discPoint() in single precision
  const Eigen::Vector2f disc(u * std::sqrt(1 - 0.5f * v * v), v * std::sqrt(1 - 0.5f * u * u));
  const Disc& from = lights_[size_t(light)];
  return from.centre + disc.x() * from.x + disc.y() * from.y - p;
}

bool FastLook::faces(int light, const SurfacePoint& point) const {
  const Eigen::Vector3f to_light = lights_[size_t(light)].centre - point.p;
  return point.normal.dot(to_light) > 0 && point.geometric.dot(to_light) > 0;
}

float FastLook::texture(const SurfacePoint& point) const {
  const Texture& texture = materials_[size_t(point.body)].texture;
  if (texture.kind == Texture::Kind::kPlain) return 1;
  if (point.body != table_) {
    const Rigid3& body_from_world = body_from_world_[size_t(point.body)];
    return float(textureFactor(texture, body_from_world * point.p.cast<double>(),
                               body_from_world.rotation * point.geometric.cast<double>()));
  }
  if (point.geometric.z() < 0.9f) return 1;  // the table's edge
  const Eigen::Vector2f at = (point.p.head<2>() - table_corner_) / texel_;
  const int x = std::clamp(int(at.x()), 0, table_texture_.cols - 2);
  const int y = std::clamp(int(at.y()), 0, table_texture_.rows - 2);
  const float s = at.x() - float(x), t = at.y() - float(y);
  const float *row = table_texture_[y] + x, *next = table_texture_[y + 1] + x;
  return (1 - t) * ((1 - s) * row[0] + s * row[1]) + t * ((1 - s) * next[0] + s * next[1]);
}

float FastLook::radiance(const SurfacePoint& point, const Eigen::Vector3f& towards_eye,
                         const LightShares& shares) const {
  const Material& material = materials_[size_t(point.body)];
  float diffuse = ambient_, highlights = 0;
  for (size_t k = 0; k < lights_.size(); ++k) {
    if (shares[k] <= 0) continue;
    Eigen::Vector3f to_light = lights_[k].centre - point.p;
    const float square_distance = to_light.squaredNorm();
    to_light /= std::sqrt(square_distance);
    const float cosine = point.normal.dot(to_light);
    if (cosine <= 0 || point.geometric.dot(to_light) <= 0) continue;
    const float irradiance = shares[k] * lights_[k].intensity / square_distance * cosine;
    diffuse += irradiance;
    const float half_cosine = point.normal.dot((to_light + towards_eye).normalized());
    highlights += irradiance * float(highlight(material, half_cosine));
  }
  return float(material.albedo) * texture(point) * diffuse + float(material.specular) * highlights;
}

}  // namespace monocular_eye_hand
