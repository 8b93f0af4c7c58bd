#pragma once
#include <gmock/gmock.h>

#include <cmath>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// Where the origin of two poses lies apart [mm].
inline double millimetresBetween(const Rigid3& a, const Rigid3& b) {
  return 1e3 * (a.translation - b.translation).norm();
}

/// Angle between the rotations of two poses [deg], exact also when it is tiny (an acos of the trace is not).
inline double degreesBetween(const Rigid3& a, const Rigid3& b) {
  return (logSO3(a.rotation.transpose() * b.rotation)).norm() * 180 / M_PI;
}

/// EXPECT_THAT(pose, PoseNear(expected, 0.1, 0.05)): within 0.1 mm and 0.05 degrees.
MATCHER_P3(PoseNear, expected, mm, deg, "") {
  const double apart = millimetresBetween(arg, expected), angle = degreesBetween(arg, expected);
  *result_listener << "which is " << apart << " mm and " << angle << " degrees off";
  return apart <= mm && angle <= deg;
}

}  // namespace monocular_eye_hand
