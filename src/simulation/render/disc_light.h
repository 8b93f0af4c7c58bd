#pragma once
#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

// The shading of both renderers: Lambert and Blinn-Phong under disc lights. `Real` is the precision of sums.

/// A Light of a scene with its disc.
struct DiscLight {
  Eigen::Vector3f centre, x, y;  ///< world; x, y span the disc, length = radius
  double intensity;
};
std::vector<DiscLight> discLights(const Scene& scene);

/// Maps the unit square to the unit disc (Shirley and Chiu would be area-true; this one needs no angle
/// functions and makes the disc a little brighter near four points of its rim).
template <class Real>
Eigen::Matrix<Real, 2, 1> discPoint(const Eigen::Matrix<Real, 2, 1>& square) {
  const Real u = 2 * square.x() - 1, v = 2 * square.y() - 1;
  return {u * std::sqrt(1 - Real(0.5) * v * v), v * std::sqrt(1 - Real(0.5) * u * u)};
}

/// From p to this point of the light's disc.
template <class Real>
Eigen::Vector3f toDisc(const DiscLight& light, const Eigen::Matrix<Real, 2, 1>& square,
                       const Eigen::Vector3f& p) {
  const Eigen::Matrix<Real, 2, 1> disc = discPoint(square);
  return light.centre + float(disc.x()) * light.x + float(disc.y()) * light.y - p;
}

/// Blinn-Phong lobe at this cosine between normal and half vector, scaled to the same total for every
/// exponent.
double highlight(const Material& material, double half_cosine);

/// A point to be lit, world frame.
struct LitPoint {
  Eigen::Vector3f p;
  Eigen::Vector3f normal;  ///< of shading
  Eigen::Vector3f facing;  ///< decides which side faces a light
  Eigen::Vector3f towards_eye;
};

template <class Real>
struct Illumination {
  Real diffuse, highlights;
};

/// Adds what a light gives to a point. `share`: function that tells how much of the light reaches the point,
/// 0 in the shadow to 1; asked only when the point faces the light. The disc's middle gives the amount of
/// light: smooth where nothing is hidden.
template <class Real, class Share>
void addLight(const DiscLight& light, const LitPoint& point, const Material& material, const Share& share,
              Illumination<Real>* sum) {
  Eigen::Vector3f to_light = light.centre - point.p;
  const float square_distance = to_light.squaredNorm();
  to_light /= std::sqrt(square_distance);
  const float cosine = point.normal.dot(to_light);
  if (cosine <= 0 || point.facing.dot(to_light) <= 0) return;

  const Real reaching = share();
  if (reaching <= 0) return;
  const Real irradiance = reaching * Real(light.intensity) / square_distance * cosine;
  sum->diffuse += irradiance;
  const float half_cosine = point.normal.dot((to_light + point.towards_eye).normalized());
  sum->highlights += irradiance * Real(highlight(material, half_cosine));
}

}  // namespace monocular_eye_hand
