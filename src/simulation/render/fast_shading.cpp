#include "simulation/render/fast_shading.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "simulation/render/parallel_rows.h"
#include "simulation/render/texture.h"

namespace monocular_eye_hand {
namespace {

constexpr double kTexel = 0.0005;  // finest grid of the table's texture [m]
constexpr double kMaxTexels = 6e6;

}  // namespace

FastShading::FastShading(const Scene& scene, std::vector<Material> materials, int table, int threads)
    : materials_(std::move(materials)),
      ambient_(float(scene.ambient)),
      background_(float(scene.background)),
      lights_(discLights(scene)),
      table_(table) {
  if (scene.lights.size() > size_t(kMaxLights))
    throw BadInput(fmt::format("lights: {} given, at most {} possible", scene.lights.size(), kMaxLights));
  if (table_ >= 0 && scene.table.material.texture.kind != Texture::Kind::kPlain)
    drawTable(scene.table, threads);
}

void FastShading::drawTable(const Table& table, int threads) {
  const double length = 2 * table.half_width, width = 2 * table.half_depth;
  const double texel = std::max(kTexel, std::sqrt(length * width / kMaxTexels));
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

void FastShading::place(const std::vector<Rigid3>& world_from_body) {
  body_from_world_.clear();
  for (const Rigid3& pose : world_from_body) body_from_world_.push_back(pose.inverse());
}

Eigen::Vector3f FastShading::toLight(int light, const Eigen::Vector3f& p,
                                     const Eigen::Vector2f& square) const {
  return toDisc(lights_[size_t(light)], square, p);
}

bool FastShading::faces(int light, const SurfacePoint& point) const {
  const Eigen::Vector3f to_light = lights_[size_t(light)].centre - point.p;
  return point.normal.dot(to_light) > 0 && point.geometric.dot(to_light) > 0;
}

float FastShading::texture(const SurfacePoint& point) const {
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

float FastShading::radiance(const SurfacePoint& point, const Eigen::Vector3f& towards_eye,
                            const LightShares& shares) const {
  const Material& material = materials_[size_t(point.body)];
  const LitPoint to_be_lit{point.p, point.normal, point.geometric, towards_eye};
  Illumination<float> lit{ambient_, 0};
  for (size_t k = 0; k < lights_.size(); ++k)
    if (shares[k] > 0)
      addLight(
          lights_[k], to_be_lit, material, [&] { return shares[k]; }, &lit);
  return float(material.albedo) * texture(point) * lit.diffuse + float(material.specular) * lit.highlights;
}

}  // namespace monocular_eye_hand
