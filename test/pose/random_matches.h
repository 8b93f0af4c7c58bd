#pragma once
#include <vector>

#include "monocular_eye_hand/pose/matches.h"
#include "support/random.h"

namespace monocular_eye_hand {

inline Rigid3 randomPose(Random& random) {
  return {randomRotation(random),
          Eigen::Vector3d(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1), uniform(random, 0.5, 0.9))};
}

inline Vector6d randomStep(Random& random, double metres, double radians) {
  Vector6d d;
  d << randomDirection(random) * metres, randomDirection(random) * radians;
  return d;
}

inline std::vector<PointMatch> randomPoints(const Rigid3& pose, const Camera& camera, int count, double noise,
                                            Random& random) {
  std::vector<PointMatch> points;
  for (int i = 0; i < count; ++i) {
    PointMatch m;
    m.p_in_object =
        0.08 * Eigen::Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    m.uv = camera.project(pose * m.p_in_object) + noise * Eigen::Vector2d(normal(random), normal(random));
    m.sigma = noise > 0 ? noise : 1;
    points.push_back(m);
  }
  return points;
}

}  // namespace monocular_eye_hand
