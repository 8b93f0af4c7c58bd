#include <fmt/format.h>

#include <cmath>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

constexpr double kDegree = M_PI / 180;

void requireLength(double value, const char* field, bool may_be_negative) {
  require(std::isfinite(value) && std::abs(value) <= 10, field, value, "finite and at most 10 m");
  if (!may_be_negative) require(value >= 0, field, value, "at least 0 m");
}

}  // namespace

void JointLimit::check() const {
  require(std::isfinite(lower), "lower", lower, "finite");
  require(std::isfinite(upper), "upper", upper, "finite");
  require(upper > lower, "upper", upper, fmt::format("above lower = {:g}", lower));
  require(upper - lower <= 4 * M_PI, "upper", upper,
          fmt::format("at most 2 turns above lower = {:g}", lower));
  require(std::isfinite(velocity) && velocity > 0, "velocity", velocity, "above 0 rad/s");
  require(std::isfinite(acceleration) && acceleration > 0, "acceleration", acceleration, "above 0 rad/s^2");
}

// Sources: docs/conventions.md. The accelerations have none: they reach full speed in a quarter of a second.
Puma560Options::Puma560Options()
    : joints{{{-160 * kDegree, 160 * kDegree, 2.0, 8.0},
              {-45 * kDegree, 225 * kDegree, 1.5, 6.0},
              {-225 * kDegree, 45 * kDegree, 1.5, 6.0},
              {-110 * kDegree, 170 * kDegree, 2.0, 8.0},
              {-100 * kDegree, 100 * kDegree, 2.0, 8.0},
              {-266 * kDegree, 266 * kDegree, 2.0, 8.0}}} {}

void Puma560Options::check() const {
  requireLength(shoulder_height, "shoulder_height", true);
  requireLength(a2, "a2", false);
  requireLength(a3, "a3", true);
  requireLength(d3, "d3", true);
  requireLength(d4, "d4", false);
  requireLength(d6, "d6", false);
  require(a2 >= 0.01, "a2", a2, "at least 0.01 m");
  require(d4 >= 0.01, "d4", d4, "at least 0.01 m");

  for (size_t i = 0; i < joints.size(); ++i) {
    const std::string field = fmt::format("joints[{}].", i);
    try {
      joints[i].check();
    } catch (const BadInput& e) {
      throw BadInput(field + e.what());
    }
    const bool one_turn = i == 1 || i == 2 || i == 4;
    require(!one_turn || joints[i].upper - joints[i].lower < 2 * M_PI, field + "upper", joints[i].upper,
            fmt::format("less than one turn above lower = {:g}", joints[i].lower));
  }
}

}  // namespace monocular_eye_hand
