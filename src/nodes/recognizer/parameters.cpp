#include "nodes/recognizer/parameters.h"

#include <cmath>
#include <sstream>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

void requirePositive(const char* field, double value) {
  if (value > 0) return;
  std::ostringstream text;
  text << field << " = " << value << " must be positive";
  throw BadInput(text.str());
}

}  // namespace

void SupportParameters::check() const {
  if (!std::isfinite(height)) throw BadInput("support.height is not finite");
  if (!(tolerance >= 0))
    throw BadInput("support.tolerance = " + std::to_string(tolerance) + " must not be negative [m]");
  if (!(wait >= 0)) throw BadInput("support.wait = " + std::to_string(wait) + " must not be negative [s]");
}

SupportPlane supportPlane(const Rigid3& camera_from_frame, const SupportParameters& parameters) {
  return supportPlane(camera_from_frame, parameters.height, parameters.tolerance);
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
