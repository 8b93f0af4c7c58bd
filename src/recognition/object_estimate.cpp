#include "monocular_eye_hand/recognition/object_estimate.h"

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

const char* name(Decision decision) {
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
    throw BadInput("support plane: the normal has length " + std::to_string(normal.norm()) + ", not 1");
  if (!std::isfinite(offset)) throw BadInput("support plane: offset is not finite");
  if (!(tolerance >= 0))
    throw BadInput("support plane: tolerance = " + std::to_string(tolerance) + " must not be negative [m]");
}

SupportPlane supportPlane(const Rigid3& camera_from_level, double height, double tolerance) {
  SupportPlane plane;
  plane.normal = camera_from_level.rotation.col(2).normalized();
  plane.offset = plane.normal.dot(camera_from_level.translation) + height;
  plane.tolerance = tolerance;
  return plane;
}

const char* name(Fate fate) {
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
