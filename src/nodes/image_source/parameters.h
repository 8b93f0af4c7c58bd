#pragma once
#include <string>

#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

/// Parameters of the node image_source.
struct ImageSourceParameters {
  std::string source;  ///< image, folder, printf pattern (one %d or %0Nd) or video; required
  std::string
      camera_info;  ///< path of a calibration (io/camera_file.h); "": publishes an uncalibrated camera
  std::string frame_id = "camera";  ///< of images and camera_info: the optical frame
  double rate = 0;                  ///< images per second; 0: a video's own, else 10
  bool loop = true;                 ///< begin again after the last image
  bool colour = false;              ///< bgr8 instead of grey (mono8, mono16)
  bool wait_for_subscriber = true;  ///< publish nothing before the image has a subscriber

  void check() const {
    requireGiven("source", source, "an image, a folder, a pattern as img_%04d.png, or a video");
    requireNotNegative("rate", rate);
    requireGiven("frame_id", frame_id, "the camera's optical frame");
  }
  template <class Visitor>
  void visit(Visitor&& v) {
    v("source", source);
    v("camera_info", camera_info);
    v("frame_id", frame_id);
    v("rate", rate);
    v("loop", loop);
    v("colour", colour);
    v("wait_for_subscriber", wait_for_subscriber);
  }
};

}  // namespace monocular_eye_hand
