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
    ExecutorOptions::visit(v);
    v("base_frame", base_frame);
    v("diagnostic_period", diagnostic_period);
  }
};

}  // namespace monocular_eye_hand
