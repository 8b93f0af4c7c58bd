#pragma once
#include <Eigen/Geometry>
#include <random>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline double normal(Random& random) { return std::normal_distribution<double>()(random); }
inline Eigen::Vector3d randomDirection(Random& random) {
  const double x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Vector3d(x, y, z).normalized();
}
inline Eigen::Matrix3d randomRotation(Random& random) {
  Eigen::Vector4d q;
  for (int i = 0; i < 4; ++i) q[i] = normal(random);
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}
inline Camera testCamera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 600;
  camera.fy = 605;
  camera.cx = 322;
  camera.cy = 236;
  return camera;
}

}  // namespace monocular_eye_hand
