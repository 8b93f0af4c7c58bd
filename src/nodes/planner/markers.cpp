#include "nodes/planner/markers.h"

#include <array>

#include "nodes/common/conversion.h"
#include "nodes/common/markers.h"

namespace monocular_eye_hand {
namespace {

using visualization_msgs::Marker;

constexpr double kLineWidth = 0.004;    // [m]
constexpr double kAboveTable = 0.001;   // of the lines, to be seen [m]
constexpr double kStrokeLength = 0.04;  // of a place [m]

Rigid3 upright(double x, double y, double z, double yaw) { return poseOf(x, y, z, 0, 0, yaw); }

Marker begin(const PlannerParameters& parameters, const char* space, int id, int type) {
  Marker marker;
  marker.header.frame_id = parameters.base_frame;  // stamp 0: it stands still
  marker.ns = space;
  marker.id = id;
  marker.type = type;
  marker.lifetime = ros::Duration(kRepeatedLifetime);
  marker.pose.orientation.w = 1;
  marker.color = toColour(0.55, 0.5, 0.45);
  return marker;
}

Marker boxMarker(const PlannerParameters& parameters, const char* space, int id, const Rigid3& base_from_box,
                 const std::array<double, 3>& size) {
  Marker marker = begin(parameters, space, id, Marker::CUBE);
  marker.pose = toPose(base_from_box);
  marker.scale.x = size[0];
  marker.scale.y = size[1];
  marker.scale.z = size[2];
  return marker;
}

Marker tableMarker(const PlannerParameters& parameters) {
  const WorkTable& table = parameters.table;
  return boxMarker(parameters, "table", 0, table.baseFromBox(), {table.length, table.width, table.thickness});
}

/// In the plane of the shape.
void addFlatLine(const Rigid3& base_from_shape, const Eigen::Vector2d& p, const Eigen::Vector2d& q,
                 Marker* marker) {
  addLine(base_from_shape * Eigen::Vector3d(p.x(), p.y(), 0),
          base_from_shape * Eigen::Vector3d(q.x(), q.y(), 0), marker);
}

Marker dropZoneMarker(const PlannerParameters& parameters) {
  const DropZone& zone = parameters.drop_zone;
  const double z = parameters.table.z + kAboveTable;
  Marker marker = begin(parameters, "drop_zone", 0, Marker::LINE_LIST);
  marker.scale.x = kLineWidth;
  marker.color = toColour(0.2, 0.9, 0.4);

  if (zone.list.empty()) {
    const Rigid3 rectangle = upright(zone.x, zone.y, z, zone.yaw);
    const double a = zone.length / 2, b = zone.width / 2;
    const std::array<Eigen::Vector2d, 4> corners{Eigen::Vector2d(-a, -b), {a, -b}, {a, b}, {-a, b}};
    for (size_t k = 0; k < 4; ++k) addFlatLine(rectangle, corners[k], corners[(k + 1) % 4], &marker);
  }

  for (const DropPlace& place : zone.places())
    addFlatLine(upright(place.x, place.y, z, place.yaw), {-kStrokeLength / 2, 0}, {kStrokeLength / 2, 0},
                &marker);
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray cellMarkers(const PlannerParameters& parameters) {
  visualization_msgs::MarkerArray array;
  array.markers = {tableMarker(parameters), dropZoneMarker(parameters)};
  const std::vector<CellBox>& boxes = parameters.boxes;
  for (size_t k = 0; k < boxes.size(); ++k)
    array.markers.push_back(boxMarker(parameters, "boxes", int(k), boxes[k].baseFromBox(), boxes[k].size));
  return array;
}

}  // namespace monocular_eye_hand
