#pragma once
#include <Eigen/Geometry>
#include <random>

#include "monocular_eye_hand/geometry/rigid3.h"

// Random numbers and poses of tests. Each takes the generator that the test has seeded.
namespace monocular_eye_hand {

using Random = std::mt19937_64;

template <class Generator>
double uniform(Generator& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Mean 0, sigma 1.
template <class Generator>
double normal(Generator& random) {
  return std::normal_distribution<double>()(random);
}

/// Each component with mean 0 and sigma 1.
template <class Generator>
Eigen::Vector3d randomVector(Generator& random) {
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

template <class Generator>
Eigen::Vector3d randomDirection(Generator& random) {
  return randomVector(random).normalized();
}

/// All rotations are equally likely.
template <class Generator>
Eigen::Matrix3d randomRotation(Generator& random) {
  Eigen::Vector4d q;
  for (int i = 0; i < 4; ++i) q[i] = normal(random);
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

}  // namespace monocular_eye_hand
