#include "monocular_eye_hand/geometry/require.h"

#include <cmath>
#include <sstream>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

void require(bool holds, const std::string& field, double value, const std::string& rule) {
  if (holds) return;
  std::ostringstream text;
  text << field << " = " << value << " must be " << rule;
  throw BadInput(text.str());
}

void requirePositive(const std::string& field, double value) {
  require(std::isfinite(value) && value > 0, field, value, "positive");
}

void requireGiven(const std::string& field, const std::string& value, const std::string& what) {
  if (value.empty()) throw BadInput(field + " is not set: give " + what);
}

}  // namespace monocular_eye_hand
