#include "nodes/eye_hand/grasp_arrows.h"

#include <algorithm>

#include "nodes/common/markers.h"

namespace monocular_eye_hand {
namespace {

using visualization_msgs::Marker;

Marker arrow(const GraspTarget& target) {
  Marker marker;
  marker.type = Marker::ARROW;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1;
  marker.points = {target.pregrasp.position, target.grasp.position};
  // Shaft, head and the head's length [m].
  marker.scale.x = 0.006;
  marker.scale.y = 0.014;
  marker.scale.z = 0.02;
  // The better the grasp the greener.
  marker.color.r = float(1 - target.quality);
  marker.color.g = float(target.quality);
  marker.color.a = 1;
  marker.lifetime = ros::Duration(kRepeatedLifetime);
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray GraspArrows::build(const GraspTargetArray& grasps) {
  visualization_msgs::MarkerArray array;
  std::vector<std::pair<std::string, int>> shown;
  const auto add = [&](Marker marker, const std::pair<std::string, int>& key) {
    marker.header.frame_id = grasps.header.frame_id;  // stamp 0, as the objects' markers
    marker.ns = key.first;
    marker.id = key.second;
    array.markers.push_back(marker);
  };

  for (const GraspTarget& target : grasps.targets) {
    if (!target.feasible) continue;
    shown.emplace_back(target.name + "/grasp", target.instance);
    add(arrow(target), shown.back());
  }

  for (const auto& key : shown_) {
    if (std::find(shown.begin(), shown.end(), key) != shown.end()) continue;
    Marker deletion;
    deletion.action = Marker::DELETE;
    add(deletion, key);
  }

  shown_ = std::move(shown);
  return array;
}

}  // namespace monocular_eye_hand
