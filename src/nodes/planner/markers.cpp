#include "nodes/planner/markers.h"

#include <Eigen/Geometry>

#include "nodes/common/conversion.h"
#include "nodes/common/markers.h"

namespace monocular_eye_hand {
namespace {

using visualization_msgs::Marker;

constexpr double kLineWidth = 0.004;    // [m]
constexpr double kAboveTable = 0.001;   // of the lines, to be seen [m]
constexpr double kStrokeLength = 0.04;  // of a place [m]

Rigid3 upright(double x, double y, double z, double yaw) { return {expSO3({0, 0, yaw}), {x, y, z}}; }

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

void setSize(double x, double y, double z, Marker* marker) {
  marker->scale.x = x;
  marker->scale.y = y;
  marker->scale.z = z;
}

Marker tableMarker(const PlannerParameters& parameters) {
  const WorkTable& table = parameters.table;
  Marker marker = begin(parameters, "table", 0, Marker::CUBE);
  marker.pose = toPose(upright(table.x, table.y, table.z - table.thickness / 2, table.yaw));
  setSize(table.length, table.width, table.thickness, &marker);
  return marker;
}

Marker boxMarker(const PlannerParameters& parameters, int k) {
  const CellBox& box = parameters.boxes[size_t(k)];
  Marker marker = begin(parameters, "boxes", k, Marker::CUBE);
  marker.pose = toPose(box.baseFromBox());
  setSize(box.size[0], box.size[1], box.size[2], &marker);
  return marker;
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
    addFlatLine(rectangle, {-a, -b}, {a, -b}, &marker);
    addFlatLine(rectangle, {a, -b}, {a, b}, &marker);
    addFlatLine(rectangle, {a, b}, {-a, b}, &marker);
    addFlatLine(rectangle, {-a, b}, {-a, -b}, &marker);
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
  for (int k = 0; k < int(parameters.boxes.size()); ++k) array.markers.push_back(boxMarker(parameters, k));
  return array;
}

}  // namespace monocular_eye_hand
