#include "monocular_eye_hand/recognition/object_estimate.h"

#include <fmt/format.h>

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

std::string toString(Decision decision) {
  switch (decision) {
    case Decision::kAccepted:
      return "accepted";
    case Decision::kRejected:
      return "rejected";
    case Decision::kAmbiguous:
      return "ambiguous";
  }
  return "unknown";
}

void SupportPlane::check() const {
  if (!(std::abs(normal.norm() - 1) < 1e-6))
    throw BadInput(fmt::format("support plane: the normal has length {:g}, not 1", normal.norm()));
  if (!std::isfinite(offset)) throw BadInput("support plane: offset is not finite");
  if (!(tolerance >= 0))
    throw BadInput(fmt::format("support plane: tolerance = {:g} must not be negative [m]", tolerance));
}

SupportPlane supportPlane(const Rigid3& camera_from_level, double height, double tolerance) {
  SupportPlane plane;
  plane.normal = camera_from_level.rotation.col(2).normalized();
  plane.offset = plane.normal.dot(camera_from_level.translation) + height;
  plane.tolerance = tolerance;
  return plane;
}

std::string toString(Fate fate) {
  switch (fate) {
    case Fate::kAccepted:
      return "accepted";
    case Fate::kAmbiguous:
      return "ambiguous";
    case Fate::kRejected:
      return "rejected";
    case Fate::kSuppressed:
      return "suppressed";
  }
  return "unknown";
}

}  // namespace monocular_eye_hand
