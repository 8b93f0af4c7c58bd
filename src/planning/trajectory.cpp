#include "monocular_eye_hand/planning/trajectory.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

TrajectoryState Trajectory::sample(double time_s) const {
  if (points.empty()) throw BadInput("the trajectory has no points");
  const double t = std::clamp(time_s, 0.0, duration());
  const auto later =
      std::upper_bound(points.begin(), points.end(), t,
                       [](double value, const TrajectoryState& p) { return value < p.time_s; });
  TrajectoryState state = *(later - 1);
  const double dt = t - state.time_s;
  state.position += dt * state.velocity + dt * dt / 2 * state.acceleration;
  state.velocity += dt * state.acceleration;
  state.time_s = time_s;
  if (time_s < 0 || time_s > duration()) state.acceleration.setZero();
  return state;
}

CollisionPair firstCollision(const CollisionWorld& world, const Trajectory& trajectory, double resolution) {
  if (!(resolution > 0)) throw BadInput("the resolution must be above 0 rad");
  for (size_t i = 0; i < trajectory.points.size(); ++i) {
    const TrajectoryState& a = trajectory.points[i];
    int steps = 1;
    double dt = 0;
    if (i + 1 < trajectory.points.size()) {
      dt = trajectory.points[i + 1].time_s - a.time_s;
      const double fastest = std::max(a.velocity.norm(), trajectory.points[i + 1].velocity.norm());
      steps = std::max(1, int(std::ceil(fastest * dt / resolution)));
    }
    for (int k = 0; k < steps; ++k) {
      const double t = dt * k / steps;
      CollisionPair pair = world.firstCollision(a.position + t * a.velocity + t * t / 2 * a.acceleration);
      if (!pair.first.empty()) return pair;
    }
  }
  return {};
}

}  // namespace monocular_eye_hand
