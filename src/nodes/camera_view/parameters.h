#pragma once
#include <string>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

/// Parameters of the node camera_view.
struct CameraViewParameters {
  std::string camera_frame;                ///< the camera's optical frame; "": that of the first image
  std::string view_frame = "camera_view";  ///< of the frame with z up
  std::string image_transport = "raw";     ///< transport of the image subscription

  void check() const {
    if (view_frame.empty()) throw BadInput("view_frame is empty: name the frame");
    if (image_transport.empty())
      throw BadInput("image_transport is empty: say raw, or one that is installed");
  }
  template <class Visitor>
  void visit(Visitor&& v) {
    v("camera_frame", camera_frame);
    v("view_frame", view_frame);
    v("image_transport", image_transport);
  }
};

}  // namespace monocular_eye_hand
