#include "nodes/recognizer_parameters.h"

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void SupportParameters::check() const {
  if (!std::isfinite(height)) throw BadInput("support.height is not finite");
  if (!(tolerance >= 0))
    throw BadInput("support.tolerance = " + std::to_string(tolerance) + " must not be negative [m]");
  if (!(wait >= 0)) throw BadInput("support.wait = " + std::to_string(wait) + " must not be negative [s]");
}

SupportPlane supportPlane(const Rigid3& camera_from_frame, const SupportParameters& parameters) {
  SupportPlane plane;
  plane.normal = camera_from_frame.rotation.col(2).normalized();
  plane.offset = plane.normal.dot(camera_from_frame.translation) + parameters.height;
  plane.tolerance = parameters.tolerance;
  return plane;
}

void RecognizerParameters::check() const {
  support.check();
  if (objects.empty())
    throw BadInput(
        "objects is not set: give the path of the model base, e.g. config/objects.yaml of this package");
  if (on_request && continuous)
    throw BadInput(
        "on_request = true needs continuous = false: either every image or those that are asked for");
  requirePositive("service_timeout", service_timeout);
  requirePositive("diagnostic_period", diagnostic_period);
  if (marker_triangles < 0)
    throw BadInput("marker_triangles = " + std::to_string(marker_triangles) + " must not be negative");
  requirePositive("label_height", label_height);
  if (!(marker_lifetime >= 0))
    throw BadInput("marker_lifetime = " + std::to_string(marker_lifetime) +
                   " must not be negative; 0: markers stay for ever");
  if (image_transport.empty())
    throw BadInput("image_transport is empty: say raw, or a transport that is installed");
}

}  // namespace monocular_eye_hand
