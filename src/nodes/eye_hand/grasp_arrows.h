#pragma once
#include <monocular_eye_hand/GraspTargetArray.h>
#include <visualization_msgs/MarkerArray.h>

#include "nodes/common/markers.h"

namespace monocular_eye_hand {

/// Arrows from pre-grasp to grasp for rviz, namespace "<name>/grasp", id = instance; arrows of grasps that
/// are no more are deleted.
class GraspArrows {
 public:
  visualization_msgs::MarkerArray build(const GraspTargetArray& grasps);

 private:
  ShownMarkers shown_;
};

}  // namespace monocular_eye_hand
