#include "monocular_eye_hand/parameters/recognizer.h"

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void SupportParameters::check() const {
  require(std::isfinite(height), "support.height", height, "finite");
  require(tolerance >= 0, "support.tolerance", tolerance, "0 or more [m]");
  require(wait >= 0, "support.wait", wait, "0 or more [s]");
}

void RecognizerParameters::check() const {
  support.check();
  requireGiven("objects", objects, "the path of the model base, e.g. config/objects.yaml of this package");
  if (on_request && continuous)
    throw BadInput(
        "on_request = true needs continuous = false: either every image or those that are asked for");
  requireGiven("image_transport", image_transport, "raw, or a transport that is installed");

  requirePositive("service_timeout", service_timeout);
  requirePositive("diagnostic_period", diagnostic_period);
  requireShare("doubtful", doubtful);
  require(marker_triangles >= 0, "marker_triangles", marker_triangles, "0 or more");
  requirePositive("label_height", label_height);
  require(marker_lifetime >= 0, "marker_lifetime", marker_lifetime, "0 or more; 0: markers stay for ever");
}

}  // namespace monocular_eye_hand
