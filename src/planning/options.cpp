#include "monocular_eye_hand/planning/options.h"

#include <cmath>

#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

void within(const char* field, double value, double low, double high, const char* rule) {
  require(value >= low && value <= high, field, value, rule);
}

}  // namespace

void PathOptions::check() const {
  within("budget", budget, 1, 1e8, "1 to 1e8 joint vectors");
  within("resolution", resolution, 1e-4, 0.5, "0.0001 to 0.5 rad");
  within("range", range, 0.01, 100, "0.01 to 100 rad");
  within("shortcuts", shortcuts, 0, 1e6, "0 to 1e6");
  within("seed", seed, 0, 2147483647, "at least 0");
}

void CartesianOptions::check() const {
  within("deviation", deviation, 1e-6, 0.1, "1e-6 to 0.1 m");
  within("rotation_deviation", rotation_deviation, 1e-6, 0.5, "1e-6 to 0.5 rad");
  within("max_step", max_step, 1e-4, 1, "0.0001 to 1 m");
  within("max_rotation", max_rotation, 1e-3, 1, "0.001 to 1 rad");
  within("joint_jump", joint_jump, 1e-3, 3, "0.001 to 3 rad");
  within("min_singularity", min_singularity, 0, 0.3, "0 to 0.3");
}

void TimingOptions::check() const {
  require(speed > 0 && speed <= 1, "speed", speed, "above 0, at most 1");
  require(acceleration > 0 && acceleration <= 1, "acceleration", acceleration, "above 0, at most 1");
  within("tool_speed", tool_speed, 1e-3, 10, "0.001 to 10 m/s");
  within("corner", corner, 0, 0.5, "0 to 0.5 rad");
}

void PlanningOptions::check() const {
  within("padding", padding, 5e-4, 0.1, "0.0005 to 0.1 m");
  within("near_padding", near_padding, 1e-4, 0.1, "0.0001 to 0.1 m");
  require(near_padding <= padding, "near_padding", near_padding, "at most padding");
  within("near_speed", near_speed, 1e-3, 10, "0.001 to 10 m/s");
  within("candidates", candidates, 1, 216, "1 to 216");
  path.check();
  cartesian.check();
  timing.check();
}

}  // namespace monocular_eye_hand
