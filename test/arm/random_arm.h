#pragma once
#include <random>

#include "monocular_eye_hand/arm/puma560.h"

namespace monocular_eye_hand {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline JointVector randomJoints(Random& random, const Puma560Options& options) {
  JointVector q;
  for (int i = 0; i < 6; ++i)
    q[i] = uniform(random, options.joints[size_t(i)].lower, options.joints[size_t(i)].upper);
  return q;
}

/// Angle between two rotations, exact also when it is tiny (an acos of the trace is not).
inline double rotationError(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return (a - b).norm() / std::sqrt(2.0);
}

}  // namespace monocular_eye_hand
