#pragma once
#include <string>

#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

/// Parameters of the node camera_view.
struct CameraViewParameters {
  std::string camera_frame;                ///< the camera's optical frame; "": that of the first image
  std::string view_frame = "camera_view";  ///< of the frame with z up
  std::string image_transport = "raw";     ///< transport of the image subscription

  void check() const {
    requireGiven("view_frame", view_frame, "the name of the frame with z up");
    requireGiven("image_transport", image_transport, "raw, or a transport that is installed");
  }
  template <class Visitor>
  void visit(Visitor&& v) {
    v("camera_frame", camera_frame);
    v("view_frame", view_frame);
    v("image_transport", image_transport);
  }
};

}  // namespace monocular_eye_hand
