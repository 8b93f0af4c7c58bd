#pragma once
#include <array>
#include <string>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/task/camera_views.h"
#include "monocular_eye_hand/task/clear_frame.h"

namespace monocular_eye_hand {

/// Parameters of the node task: the keys of config/task.yaml. Defaults stand here and nowhere else.
struct TaskParameters {
  std::string objects;  ///< model base: path of a YAML as config/objects.yaml; required
  std::string cache;    ///< folder of compiled models; "": the user's cache, "none": no cache
  std::string urdf;     ///< path of the arm's URDF; required
  std::string base_frame = "base_link";  ///< of all poses
  /// Where the frame stands, about: the first overview looks there [m, base].
  std::array<double, 3> centre{{0.55, 0, 0.31}};
  double settle = 0.15;          ///< the camera stands so long before an image counts [s]
  double look_timeout = 30;      ///< longest wait for the image's objects [s, Moment]
  double answer_timeout = 10;    ///< ... for a service or a node to appear [s, Moment]
  double motion_timeout = 120;   ///< ... for the result of an action of the planner [s, Moment]
  double holding_width = 0.002;  ///< a gripper that closed further holds nothing [m]
  double state_max_age = 5;      ///< joint and gripper states older than this are none [s, Moment]
  CameraViewOptions views;
  ClearFrameOptions clear_frame;
  Puma560Options arm;

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("objects", objects);
    v("cache", cache);
    v("urdf", urdf);
    v("base_frame", base_frame);
    v("centre", centre);
    v("settle", settle);
    v("look_timeout", look_timeout);
    v("answer_timeout", answer_timeout);
    v("motion_timeout", motion_timeout);
    v("holding_width", holding_width);
    v("state_max_age", state_max_age);
    v("views", views);
    v("clear_frame", clear_frame);
    v("arm", arm);
  }
};

}  // namespace monocular_eye_hand
