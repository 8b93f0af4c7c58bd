#include "simulation/render/disc_light.h"

#include <Eigen/Geometry>

namespace monocular_eye_hand {

std::vector<DiscLight> discLights(const Scene& scene) {
  std::vector<DiscLight> out;
  for (const Light& light : scene.lights) {
    const Eigen::Vector3d axis = -light.position.normalized();
    const Eigen::Vector3d x = axis.unitOrthogonal();
    out.push_back({light.position.cast<float>(), (light.radius * x).cast<float>(),
                   (light.radius * axis.cross(x)).cast<float>(), light.intensity});
  }
  return out;
}

double highlight(const Material& material, double half_cosine) {
  if (material.specular <= 0 || half_cosine <= 0) return 0;
  const float exponent = float(material.shininess) * std::log2(float(half_cosine));
  return exponent < -14 ? 0 : (material.shininess + 2) / 8 * std::exp2(exponent);
}

}  // namespace monocular_eye_hand
