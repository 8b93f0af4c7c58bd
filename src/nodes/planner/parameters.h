#pragma once
#include <string>

#include "monocular_eye_hand/execution/options.h"

namespace monocular_eye_hand {

/// Parameters of the node planner: the keys of config/planner.yaml. Defaults stand here and in
/// ExecutorOptions, and nowhere else.
struct PlannerParameters : ExecutorOptions {
  std::string base_frame = "base_link";  ///< of all poses
  double diagnostic_period = 1.0;        ///< [s, wall clock]

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("objects", objects);
    v("urdf", urdf);
    v("base_frame", base_frame);
    v("table", table);
    v("boxes", boxes);
    v("drop_zone", drop_zone);
    v("drop_gap", drop_gap);
    v("drop_above", drop_above);
    v("feedback_period", feedback_period);
    v("diagnostic_period", diagnostic_period);
    v("execution", execution);
    v("planning", planning);
    v("arm", arm);
  }
};

}  // namespace monocular_eye_hand
