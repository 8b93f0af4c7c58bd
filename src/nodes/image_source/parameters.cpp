#include "nodes/image_source/parameters.h"

#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void ImageSourceParameters::check() const {
  requireGiven("source", source, "an image, a folder, a pattern as img_%04d.png, or a video");
  require(rate >= 0, "rate", rate, "0 or more");
  requireGiven("frame_id", frame_id, "the camera's optical frame");
}

}  // namespace monocular_eye_hand
