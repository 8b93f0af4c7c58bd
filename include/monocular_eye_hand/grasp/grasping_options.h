#pragma once
#include <vector>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/eye_hand/object_map_options.h"
#include "monocular_eye_hand/geometry/cell_box.h"
#include "monocular_eye_hand/grasp/grasp_plan.h"
#include "monocular_eye_hand/grasp/gripper.h"
#include "monocular_eye_hand/grasp/model_grasps.h"

namespace monocular_eye_hand {

/// The way from recognised objects to grasps: what is known of the cell, how views are merged, how a hand
/// takes hold. Defaults stand here and nowhere else.
struct GraspingOptions {
  bool table = true;           ///< everything stands above its top, and the hand keeps above it
  std::vector<CellBox> boxes;  ///< whatever else stands in the cell: nothing reaches into it
  double held_width = 0.002;   ///< between the pads of a stalled gripper: beyond, it holds something [m]
  ObjectMapOptions map;
  Puma560Options arm;
  GripperOptions gripper;
  GraspSamplingOptions sampling;
  GraspPlanOptions grasp;

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("table", table);
    v("boxes", boxes);
    v("held_width", held_width);
    v("map", map);
    v("arm", arm);
    v("gripper", gripper);
    v("sampling", sampling);
    v("grasp", grasp);
  }
};

}  // namespace monocular_eye_hand
