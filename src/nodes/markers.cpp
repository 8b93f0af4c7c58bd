#include "nodes/markers.h"

#include <algorithm>
#include <cstdio>

#include "monocular_eye_hand/drawing/canvas.h"
#include "nodes/conversion.h"

namespace monocular_eye_hand {
namespace {

using visualization_msgs::Marker;

geometry_msgs::Point toPoint(const Eigen::Vector3d& p) {
  geometry_msgs::Point point;
  point.x = p.x(), point.y = p.y(), point.z = p.z();
  return point;
}

std_msgs::ColorRGBA toColour(const Colour& bgr, double alpha) {
  std_msgs::ColorRGBA colour;
  colour.r = float(bgr[2] / 255), colour.g = float(bgr[1] / 255), colour.b = float(bgr[0] / 255);
  colour.a = float(alpha);
  return colour;
}

std::string labelSpace(const std::string& name) { return name + "/label"; }

std::string labelText(const ObjectEstimate& object, int instance) {
  char probability[16];
  std::snprintf(probability, sizeof probability, "%.2f", object.probability);
  std::string text = object.name + "_" + std::to_string(instance) + " " + probability;
  return object.decision == Decision::kAmbiguous ? text + " ambiguous" : text;
}

Marker deletion(const std_msgs::Header& header, const std::string& space, int id) {
  Marker marker;
  marker.header = header;
  marker.ns = space;
  marker.id = id;
  marker.action = Marker::DELETE;
  return marker;
}

}  // namespace

MarkerBuilder::MarkerBuilder(const ModelBase& models, int most_triangles, const Eigen::Vector3d& up)
    : models_(models), most_triangles_(most_triangles), up_(up) {}

visualization_msgs::MarkerArray MarkerBuilder::build(const std_msgs::Header& header,
                                                     const std::vector<ObjectEstimate>& objects,
                                                     const std::vector<int>& instances,
                                                     const std::string& only) {
  visualization_msgs::MarkerArray array;
  std::vector<Key> shown;
  for (size_t i = 0; i < objects.size(); ++i) {
    shown.emplace_back(objects[i].name, instances[i]);
    Marker marker = shape(header, objects[i]);
    marker.id = instances[i];
    array.markers.push_back(marker);
    array.markers.push_back(label(header, objects[i], instances[i]));
  }
  for (const Key& key : shown_) {
    if (std::find(shown.begin(), shown.end(), key) != shown.end()) continue;
    if (!only.empty() && key.first != only) {
      shown.push_back(key);
      continue;
    }
    array.markers.push_back(deletion(header, key.first, key.second));
    array.markers.push_back(deletion(header, labelSpace(key.first), key.second));
  }
  shown_ = std::move(shown);
  return array;
}

Marker MarkerBuilder::shape(const std_msgs::Header& header, const ObjectEstimate& object) const {
  const ObjectModel& model = models_.objects.at(size_t(object.object)).model;
  Marker marker;
  marker.header = header;
  marker.ns = object.name;
  marker.action = Marker::ADD;
  marker.pose = toPose(object.camera_from_object);
  marker.color = toColour(paletteColour(object.object), object.decision == Decision::kAmbiguous ? 0.4 : 0.85);
  if (model.mesh.triangles.size() <= size_t(most_triangles_)) {
    marker.type = Marker::TRIANGLE_LIST;
    marker.scale.x = marker.scale.y = marker.scale.z = 1;
    marker.points.reserve(model.mesh.triangles.size() * 3);
    for (const std::array<int, 3>& triangle : model.mesh.triangles)
      for (int vertex : triangle) marker.points.push_back(toPoint(model.mesh.vertices[size_t(vertex)]));
  } else {
    marker.type = Marker::LINE_LIST;
    marker.scale.x = model.diameter / 100;
    for (const ModelEdge& edge : model.edges) {
      marker.points.push_back(toPoint(edge.p));
      marker.points.push_back(toPoint(edge.q));
    }
  }
  return marker;
}

Marker MarkerBuilder::label(const std_msgs::Header& header, const ObjectEstimate& object,
                            int instance) const {
  const ObjectModel& model = models_.objects.at(size_t(object.object)).model;
  Marker marker;
  marker.header = header;
  marker.ns = labelSpace(object.name);
  marker.id = instance;
  marker.type = Marker::TEXT_VIEW_FACING;
  marker.action = Marker::ADD;
  marker.pose.position = toPoint(object.camera_from_object * model.centre() + 0.6 * model.diameter * up_);
  marker.pose.orientation.w = 1;
  marker.scale.z = model.diameter / 6;
  marker.color = toColour(Colour(255, 255, 255), 1);
  marker.text = labelText(object, instance);
  return marker;
}

}  // namespace monocular_eye_hand
