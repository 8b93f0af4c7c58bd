#include "monocular_eye_hand/geometry/require.h"

#include <fmt/format.h>

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

void require(bool holds, const std::string& field, double value, const std::string& rule) {
  if (holds && std::isfinite(value)) return;
  throw BadInput(fmt::format("{} = {:g} must be {}", field, value, rule));
}

void requireFinite(const std::string& field, double value) { require(true, field, value, "finite"); }

void requirePositive(const std::string& field, double value) { require(value > 0, field, value, "positive"); }

void requireNotNegative(const std::string& field, double value) {
  require(value >= 0, field, value, "0 or more");
}

void requireShare(const std::string& field, double value) {
  require(value >= 0 && value <= 1, field, value, "between 0 and 1");
}

void requireGiven(const std::string& field, const std::string& value, const std::string& what) {
  if (value.empty()) throw BadInput(field + " is not set: give " + what);
}

}  // namespace monocular_eye_hand
