#pragma once
#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// Markers of what lasts are published again and again, and go when their node does.
constexpr double kMarkerRepeat = 1.0;       ///< [s, wall clock]
constexpr double kRepeatedLifetime = 10.0;  ///< [s]: the clock may run fast

/// Opaque; red, green and blue are 0..1.
std_msgs::ColorRGBA toColour(double r, double g, double b);
/// A LINE_LIST without lines; `width` [m].
visualization_msgs::Marker lineList(double width);
void addLine(const Eigen::Vector3d& p, const Eigen::Vector3d& q, visualization_msgs::Marker* marker);

/// What a topic shows, so that markers of what is no more are deleted.
class ShownMarkers {
 public:
  /// Appends deletions of what was shown before and does not stand in `array`, but for namespaces of which
  /// `stays` says so.
  void deleteOthers(const std_msgs::Header& header, const std::function<bool(const std::string&)>& stays,
                    visualization_msgs::MarkerArray* array);

 private:
  using Key = std::pair<std::string, int>;  // namespace, id
  std::vector<Key> shown_;
};

/// How objects are shown.
struct MarkerStyle {
  int max_triangles = 20000;   ///< of a mesh; above, an object is shown by its edges
  double label_height = 0.02;  ///< of a capital letter, the same for all objects [m]
  /// Where the texts stand from their object, in the header's frame; in an optical frame above is -y.
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
};

/// Objects of one image for rviz: an accepted one by its CAD model (TRIANGLE_LIST, opaque: rviz does not sort
/// the triangles of transparent ones), an ambiguous one by its edges (LINE_LIST), in namespace "<name>"; its
/// axes in "<name>/axes", one line of text in "<name>/label"; id = instance. Colour by object. Markers that a
/// former image had and this one has not are deleted; the first array deletes what a former run of the node
/// left.
class MarkerBuilder {
 public:
  /// `models` must outlive the builder.
  MarkerBuilder(const ModelBase& models, const MarkerStyle& style);
  /// `only`: the one name that was looked for; markers of other names stay as they are. "": all. `lifetime`:
  /// after so long without a new array they go by themselves [s]; 0: never.
  visualization_msgs::MarkerArray build(const std_msgs::Header& header,
                                        const std::vector<ObjectEstimate>& objects,
                                        const std::vector<int>& instances, double lifetime,
                                        const std::string& only = "");

 private:
  visualization_msgs::Marker shape(const ObjectEstimate& object) const;
  visualization_msgs::Marker axes(const ObjectEstimate& object) const;
  visualization_msgs::Marker label(const ObjectEstimate& object, int instance) const;

  const ModelBase& models_;
  MarkerStyle style_;
  bool begun_ = false;
  ShownMarkers shown_;
};

/// What the camera sees, as far as `depth` [m]: edges of the pyramid and its base as a LINE_LIST that moves
/// with the camera's optical frame.
visualization_msgs::Marker viewMarker(const std::string& optical_frame, const Camera& camera, double depth);

/// Deletes every marker of a topic; `frame`: one that tf knows, else rviz drops the message.
visualization_msgs::Marker deleteAllMarker(const std::string& frame);

}  // namespace monocular_eye_hand
