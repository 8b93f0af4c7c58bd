#pragma once
#include <string>

#include "monocular_eye_hand/recognition/options.h"
#include "monocular_eye_hand/tracking/object_tracker.h"

namespace monocular_eye_hand {

/// The plane that the parts stand on.
struct SupportParameters {
  std::string frame;         ///< level frame of tf, z up; "": no plane is known
  double height = 0;         ///< z of the plane in it [m]
  double tolerance = 0.004;  ///< a part may seem to reach this much below it [m]
  double wait = 0.2;         ///< longest wait for tf of an image [s, wall clock]

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("frame", frame);
    v("height", height);
    v("tolerance", tolerance);
    v("wait", wait);
  }
};

/// Parameters of the node recognizer: the keys of config/recognizer.yaml. Defaults stand here and nowhere
/// else.
struct RecognizerParameters {
  std::string objects;       ///< model base: path of a YAML as config/objects.yaml; required
  std::string cache;         ///< folder of compiled models; "": the user's cache, "none": no cache
  bool rectified = false;    ///< subscribe to image_rect (P, no distortion) instead of image_raw (K and D)
  bool continuous = true;    ///< work on every image; false: only while someone listens or asks
  bool on_request = false;   ///< work only when ~recognize is called, whoever listens to the results
  std::string frame_prefix;  ///< before the name of every object's tf frame
  std::string camera_frame;  ///< optical frame of the results; "": the image's header.frame_id
  std::string image_transport = "raw";  ///< transport of the image subscription
  double service_timeout = 5.0;         ///< longest wait of ~recognize for an image [s, wall clock]
  /// Rejected candidates from this probability on are published, too, as REJECTED, for who merges views; 1:
  /// none.
  double doubtful = 1.0;
  int marker_triangles = 20000;    ///< meshes with more triangles are shown by their sharp edges
  double label_height = 0.02;      ///< of the markers' texts [m]
  double marker_lifetime = 5.0;    ///< markers go when no image came for so long [s]; 0: never
  double diagnostic_period = 1.0;  ///< [s, wall clock]
  SupportParameters support;
  ObjectTrackerOptions instances;
  RecognitionOptions recognition;

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("objects", objects);
    v("cache", cache);
    v("rectified", rectified);
    v("continuous", continuous);
    v("on_request", on_request);
    v("frame_prefix", frame_prefix);
    v("camera_frame", camera_frame);
    v("image_transport", image_transport);
    v("service_timeout", service_timeout);
    v("doubtful", doubtful);
    v("marker_triangles", marker_triangles);
    v("label_height", label_height);
    v("marker_lifetime", marker_lifetime);
    v("diagnostic_period", diagnostic_period);
    v("support", support);
    v("instances", instances);
    v("recognition", recognition);
  }
};

}  // namespace monocular_eye_hand
