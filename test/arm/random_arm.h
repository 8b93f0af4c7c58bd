#pragma once
#include <cmath>

#include "monocular_eye_hand/arm/puma560.h"
#include "support/random.h"

namespace monocular_eye_hand {

inline JointVector randomJoints(Random& random, const Puma560Options& options) {
  JointVector q;
  for (int i = 0; i < 6; ++i)
    q[i] = uniform(random, options.joints[size_t(i)].lower, options.joints[size_t(i)].upper);
  return q;
}

inline double stretchedElbow(const Puma560Options& o) { return -std::atan2(o.d4, o.a3); }

/// q2 that puts the wrist centre on the plane of axis 1 across the arm.
inline double uprightShoulder(const Puma560Options& o, double q3) {
  const double along = o.a2 + o.a3 * std::cos(q3) - o.d4 * std::sin(q3);
  const double across = o.a3 * std::sin(q3) + o.d4 * std::cos(q3);
  return M_PI / 2 - std::atan2(across, along);
}

/// Tiny, of any size down to nothing at all.
inline double tiny(Random& random) {
  const double exponent = uniform(random, -20, -1), sign = uniform(random, -1, 1);
  return exponent < -18 ? 0 : std::copysign(std::pow(10, exponent), sign);
}

/// Joints at `tiny` distances from the singularities of the bits of `which`: 1 shoulder, 2 elbow, 4 wrist.
inline JointVector nearSingular(Random& random, const Puma560Options& o, int which) {
  JointVector q = randomJoints(random, o);
  if (which & 2) q[2] = stretchedElbow(o) + tiny(random);
  if (which & 1) q[1] = uprightShoulder(o, q[2]) + tiny(random);
  if (which & 4) q[4] = tiny(random);
  return q;
}

/// Angle between two rotations, exact also when it is tiny (an acos of the trace is not).
inline double rotationError(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return (a - b).norm() / std::sqrt(2.0);
}

}  // namespace monocular_eye_hand
