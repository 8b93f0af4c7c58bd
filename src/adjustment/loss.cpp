#include "monocular_eye_hand/adjustment/loss.h"

#include <cmath>

#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

double RobustLoss::cost(double squared_length) const {
  switch (kind) {
    case Kind::kHuber:
      return squared_length <= width * width ? squared_length
                                             : 2 * width * std::sqrt(squared_length) - width * width;
    case Kind::kCauchy:
      return width * width * std::log1p(squared_length / (width * width));
    case Kind::kSquares:
      break;
  }
  return squared_length;
}

double RobustLoss::weight(double squared_length) const {
  switch (kind) {
    case Kind::kHuber:
      return squared_length <= width * width ? 1 : width / std::sqrt(squared_length);
    case Kind::kCauchy:
      return 1 / (1 + squared_length / (width * width));
    case Kind::kSquares:
      break;
  }
  return 1;
}

void RobustLoss::check() const {
  if (kind != Kind::kSquares) requirePositive("width of the robust loss", width);
}

}  // namespace monocular_eye_hand
