#include "simulation/scenes/random_draws.h"

#include <cmath>

namespace monocular_eye_hand {

Texture randomTexture(Generator* random, double amplitude) {
  if (amplitude <= 0) return {};
  static const Texture::Kind kKinds[] = {Texture::Kind::kNoise, Texture::Kind::kWood, Texture::Kind::kBricks,
                                         Texture::Kind::kChecker, Texture::Kind::kNoise};
  Texture texture;
  texture.kind = kKinds[random->integer(0, 4)];
  texture.scale = random->uniform(0.008, 0.05);
  texture.amplitude = amplitude * random->uniform(0.5, 1.0);
  texture.seed = random->bits();
  return texture;
}

Material randomMaterial(Generator* random) {
  Material material;
  material.albedo = random->uniform(0.10, 0.80);
  material.specular = random->uniform(0.02, 0.25);
  material.shininess = random->uniform(10, 80);
  return material;
}

void standOut(Material* material, double table_albedo) {
  if (std::abs(material->albedo - table_albedo) >= 0.2) return;
  material->albedo = table_albedo > 0.45 ? table_albedo - 0.25 : table_albedo + 0.25;
}

const Rigid3& drawPose(const std::vector<StablePose>& poses, Generator* random) {
  double left = random->uniform(0, 1);
  for (const StablePose& pose : poses)
    if ((left -= pose.weight) < 0) return pose.table_from_object;
  return poses.front().table_from_object;
}

void addLights(Generator* random, Scene* scene) {
  scene->ambient = random->uniform(0.15, 0.5);
  scene->background = random->uniform(0.03, 0.4);
  const int count = random->integer(1, 3);
  for (int k = 0; k < count; ++k) {
    const double azimuth = random->uniform(0, 2 * M_PI), elevation = random->uniform(30, 85) * M_PI / 180;
    const double distance = random->uniform(0.8, 1.5);
    Light light;
    light.position = distance * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    light.radius = random->uniform(0.03, 0.4);
    light.intensity = random->uniform(0.5, 1.5) / count;
    scene->lights.push_back(light);
  }
}

}  // namespace monocular_eye_hand
