#pragma once
#include "monocular_eye_hand/planning/trajectory.h"

namespace monocular_eye_hand {

/// Joint 1 from 0 to 1 rad in 2 s: half of it speeding up, half slowing down.
inline Trajectory turn() {
  Trajectory trajectory;
  trajectory.points.resize(3);
  trajectory.points[0].acceleration[0] = 1;
  trajectory.points[1].time_s = 1;
  trajectory.points[1].position[0] = 0.5;
  trajectory.points[1].velocity[0] = 1;
  trajectory.points[1].acceleration[0] = -1;
  trajectory.points[2].time_s = 2;
  trajectory.points[2].position[0] = 1;
  return trajectory;
}

}  // namespace monocular_eye_hand
