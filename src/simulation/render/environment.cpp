#include "simulation/render/environment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

// 1 inside, 0 outside, smooth over +- soft about the border.
float inside(float distance, float half, float soft) {
  const float t = std::clamp(0.5f + 0.5f * (half - distance) / soft, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace

Surroundings::Surroundings(const Environment& environment)
    : low_(float(environment.low)), high_(float(environment.high)) {
  for (const Environment::Panel& panel : environment.panels) {
    const Eigen::Vector3d middle = panel.direction.normalized();
    const Eigen::Vector3d up =
        std::abs(middle.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d x = up.cross(middle).normalized();
    panels_.push_back({middle.cast<float>(), x.cast<float>(), middle.cross(x).cast<float>(),
                       float(panel.half_width), float(panel.half_height), float(panel.softness),
                       float(panel.radiance)});
  }
}

float Surroundings::radiance(const Eigen::Vector3f& direction, float spread) const {
  float value = low_ + (high_ - low_) * 0.5f * (1 + direction.z());
  for (const Panel& panel : panels_) {
    const float depth = direction.dot(panel.middle);
    if (depth <= 0.05f) continue;
    const float soft = std::max(1e-4f, panel.softness + 1.5f * spread);
    const float share = inside(std::abs(direction.dot(panel.x)) / depth, panel.half_width, soft) *
                        inside(std::abs(direction.dot(panel.y)) / depth, panel.half_height, soft);
    value += share * (panel.radiance - value);
  }
  return value;
}

}  // namespace monocular_eye_hand
