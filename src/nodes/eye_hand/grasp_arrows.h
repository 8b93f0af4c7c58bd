#pragma once
#include <monocular_eye_hand/GraspTargetArray.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <utility>
#include <vector>

namespace monocular_eye_hand {

/// Arrows from pre-grasp to grasp for rviz, namespace "<name>/grasp", id = instance; arrows of grasps that
/// are no more are deleted.
class GraspArrows {
 public:
  visualization_msgs::MarkerArray build(const GraspTargetArray& grasps);

 private:
  std::vector<std::pair<std::string, int>> shown_;  // namespace, id
};

}  // namespace monocular_eye_hand
