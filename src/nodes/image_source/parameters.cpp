#include "nodes/image_source/parameters.h"

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

void ImageSourceParameters::check() const {
  if (source.empty())
    throw BadInput("source is not set: give an image, a folder, a pattern as img_%04d.png, or a video");
  if (!(rate >= 0)) throw BadInput("rate = " + std::to_string(rate) + " must not be negative");
  if (frame_id.empty()) throw BadInput("frame_id is empty: name the camera's optical frame");
}

}  // namespace monocular_eye_hand
