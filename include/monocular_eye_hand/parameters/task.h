#pragma once
#include <string>

#include "monocular_eye_hand/task/options.h"

namespace monocular_eye_hand {

/// Parameters of the node task: the keys of config/task.yaml. Defaults stand here and in TaskOptions,
/// and nowhere else.
struct TaskParameters : TaskOptions {
  std::string objects;  ///< model base: path of a YAML as config/objects.yaml; required
  std::string cache;    ///< folder of compiled models; "": the user's cache, "none": no cache
  std::string urdf;     ///< path of the arm's URDF; required
  std::string base_frame = "base_link";  ///< of all poses
  double look_timeout = 30;              ///< longest wait for the image's objects [s, Moment]
  double answer_timeout = 10;            ///< ... for a service or a node to appear [s, Moment]
  double motion_timeout = 120;           ///< ... for the result of an action of the planner [s, Moment]
  double state_max_age = 5;              ///< joint and gripper states older than this are none [s, Moment]

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("objects", objects);
    v("cache", cache);
    v("urdf", urdf);
    v("base_frame", base_frame);
    v("look_timeout", look_timeout);
    v("answer_timeout", answer_timeout);
    v("motion_timeout", motion_timeout);
    v("state_max_age", state_max_age);
    TaskOptions::visit(v);
  }
};

}  // namespace monocular_eye_hand
