#include "nodes/common/markers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "monocular_eye_hand/drawing/canvas.h"
#include "monocular_eye_hand/model/wireframe.h"
#include "nodes/common/conversion.h"

namespace monocular_eye_hand {
namespace {

using visualization_msgs::Marker;

constexpr double kLineShare = 0.01;      // width of lines, as a share of the object's diameter
constexpr double kThinnestLine = 0.001;  // [m]
constexpr double kAxisShare = 0.5;       // length of the axes, as a share of the object's diameter
constexpr double kViewLine = 0.002;      // [m]

std_msgs::ColorRGBA objectColour(int object) {
  const Colour bgr = paletteColour(object);
  return toColour(bgr[2] / 255, bgr[1] / 255, bgr[0] / 255);
}

std::array<std::string, 3> namespacesOf(const std::string& name) {
  return {name, name + "/axes", name + "/label"};
}

std::string labelText(const ObjectEstimate& object, int instance) {
  const char* ambiguous = object.decision == Decision::kAmbiguous ? " ambiguous" : "";
  return fmt::format("{}_{} {:.2f}{}", object.name, instance, object.probability, ambiguous);
}

Marker edgesOf(const ObjectModel& model) {
  Marker marker = lineList(std::max(kThinnestLine, kLineShare * model.diameter));
  for (const WireframeLine& line : wireframe(model)) addLine(line.p, line.q, &marker);
  return marker;
}

Marker meshOf(const ObjectModel& model) {
  Marker marker;
  marker.type = Marker::TRIANGLE_LIST;
  marker.scale.x = marker.scale.y = marker.scale.z = 1;
  marker.points.reserve(model.mesh.triangles.size() * 3);
  for (const std::array<int, 3>& triangle : model.mesh.triangles)
    for (int vertex : triangle) marker.points.push_back(toPoint(model.mesh.vertices[size_t(vertex)]));
  return marker;
}

}  // namespace

std_msgs::ColorRGBA toColour(double r, double g, double b) {
  std_msgs::ColorRGBA colour;
  colour.r = float(r);
  colour.g = float(g);
  colour.b = float(b);
  colour.a = 1;
  return colour;
}

Marker lineList(double width) {
  Marker marker;
  marker.type = Marker::LINE_LIST;
  marker.pose.orientation.w = 1;
  marker.scale.x = width;
  return marker;
}

void addLine(const Eigen::Vector3d& p, const Eigen::Vector3d& q, Marker* marker) {
  marker->points.push_back(toPoint(p));
  marker->points.push_back(toPoint(q));
}

void ShownMarkers::deleteOthers(const std_msgs::Header& header,
                                const std::function<bool(const std::string&)>& stays,
                                visualization_msgs::MarkerArray* array) {
  std::vector<Key> shown;
  for (const Marker& marker : array->markers)
    if (marker.action == Marker::ADD) shown.emplace_back(marker.ns, marker.id);

  for (const Key& key : shown_) {
    if (std::find(shown.begin(), shown.end(), key) != shown.end()) continue;
    if (stays(key.first)) {
      shown.push_back(key);
      continue;
    }
    Marker deletion;
    deletion.header = header;
    deletion.ns = key.first;
    deletion.id = key.second;
    deletion.action = Marker::DELETE;
    array->markers.push_back(deletion);
  }
  shown_ = std::move(shown);
}

MarkerBuilder::MarkerBuilder(const ModelBase& models, const MarkerStyle& style)
    : models_(models), style_(style) {}

visualization_msgs::MarkerArray MarkerBuilder::build(const std_msgs::Header& header,
                                                     const std::vector<ObjectEstimate>& objects,
                                                     const std::vector<int>& instances, double lifetime,
                                                     const std::string& only) {
  visualization_msgs::MarkerArray array;
  if (!begun_) array.markers.push_back(deleteAllMarker(header.frame_id));
  begun_ = true;

  for (size_t i = 0; i < objects.size(); ++i) {
    const ObjectEstimate& object = objects[i];
    const std::array<std::string, 3> spaces = namespacesOf(object.name);
    const std::array<Marker, 3> parts{shape(object), axes(object), label(object, instances[i])};
    for (size_t k = 0; k < parts.size(); ++k) {
      Marker marker = parts[k];
      marker.header = header;
      marker.ns = spaces[k];
      marker.id = instances[i];
      marker.lifetime = ros::Duration(lifetime);
      array.markers.push_back(std::move(marker));
    }
  }

  const std::array<std::string, 3> searched = namespacesOf(only);
  const auto stays = [&](const std::string& space) {
    return !only.empty() && std::find(searched.begin(), searched.end(), space) == searched.end();
  };
  shown_.deleteOthers(header, stays, &array);
  return array;
}

Marker MarkerBuilder::shape(const ObjectEstimate& object) const {
  const ObjectModel& model = models_.objects.at(size_t(object.object)).model;
  const bool solid =
      object.decision == Decision::kAccepted && model.mesh.triangles.size() <= size_t(style_.max_triangles);
  Marker marker = solid ? meshOf(model) : edgesOf(model);
  marker.pose = toPose(object.camera_from_object);
  marker.color = objectColour(object.object);
  return marker;
}

Marker MarkerBuilder::axes(const ObjectEstimate& object) const {
  const double diameter = models_.objects.at(size_t(object.object)).model.diameter;
  Marker marker = lineList(std::max(kThinnestLine, kLineShare * diameter));
  marker.pose = toPose(object.camera_from_object);
  marker.color = toColour(1, 1, 1);  // the points have their own
  for (int k = 0; k < 3; ++k) {
    addLine(Eigen::Vector3d::Zero(), kAxisShare * diameter * Eigen::Vector3d::Unit(k), &marker);
    marker.colors.insert(marker.colors.end(), 2, toColour(k == 0, k == 1, k == 2));
  }
  return marker;
}

Marker MarkerBuilder::label(const ObjectEstimate& object, int instance) const {
  const ObjectModel& model = models_.objects.at(size_t(object.object)).model;
  const double above = 0.5 * model.diameter + style_.label_height;
  Marker marker;
  marker.type = Marker::TEXT_VIEW_FACING;
  marker.pose.position = toPoint(object.camera_from_object * model.centre() + above * style_.up);
  marker.pose.orientation.w = 1;
  marker.scale.z = style_.label_height;
  marker.color = toColour(1, 1, 1);
  marker.text = labelText(object, instance);
  return marker;
}

Marker viewMarker(const std::string& optical_frame, const Camera& camera, double depth) {
  Marker marker = lineList(kViewLine);
  marker.header.frame_id = optical_frame;  // stamp 0: where the camera is now
  marker.frame_locked = 1;
  marker.ns = "view";
  marker.color = toColour(1, 0.85, 0.2);

  const double right = camera.width - 1, bottom = camera.height - 1;
  const std::array<Eigen::Vector2d, 4> pixels{
      Eigen::Vector2d(0, 0), {right, 0}, {right, bottom}, {0, bottom}};
  std::array<Eigen::Vector3d, 4> corners;
  for (size_t k = 0; k < 4; ++k) corners[k] = depth * camera.ray(camera.undistort(pixels[k]));

  for (size_t k = 0; k < 4; ++k) {
    addLine(Eigen::Vector3d::Zero(), corners[k], &marker);
    addLine(corners[k], corners[(k + 1) % 4], &marker);
  }
  return marker;
}

Marker deleteAllMarker(const std::string& frame) {
  Marker marker;
  marker.header.frame_id = frame;
  marker.action = Marker::DELETEALL;
  return marker;
}

}  // namespace monocular_eye_hand
