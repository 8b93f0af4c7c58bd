#include "nodes/eye_hand/grasp_arrows.h"

namespace monocular_eye_hand {
namespace {

using visualization_msgs::Marker;

Marker arrow(const GraspTarget& target) {
  Marker marker;
  marker.type = Marker::ARROW;
  marker.action = Marker::ADD;
  marker.ns = target.name + "/grasp";
  marker.id = target.instance;
  marker.pose.orientation.w = 1;
  marker.points = {target.pregrasp.position, target.grasp.position};
  // Shaft, head and the head's length [m].
  marker.scale.x = 0.006;
  marker.scale.y = 0.014;
  marker.scale.z = 0.02;
  marker.color = toColour(1 - target.quality, target.quality, 0);  // the better the grasp the greener
  marker.lifetime = ros::Duration(kRepeatedLifetime);
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray GraspArrows::build(const GraspTargetArray& grasps) {
  std_msgs::Header header;  // stamp 0, as the objects' markers
  header.frame_id = grasps.header.frame_id;

  visualization_msgs::MarkerArray array;
  for (const GraspTarget& target : grasps.targets) {
    if (!target.feasible) continue;
    array.markers.push_back(arrow(target));
    array.markers.back().header = header;
  }
  shown_.deleteOthers(
      header, [](const std::string&) { return false; }, &array);
  return array;
}

}  // namespace monocular_eye_hand
