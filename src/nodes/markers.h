#pragma once
#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// Objects of one image for rviz: the CAD model at its pose (TRIANGLE_LIST; above `most_triangles` its sharp
/// edges as LINE_LIST) in namespace "<name>" and a line of text in "<name>/label", id = instance. Colour by
/// object; ambiguous ones are translucent. Markers that a former image had and this one has not are deleted.
class MarkerBuilder {
 public:
  /// `models` must outlive the builder. `up`: where the texts stand from their object, in the header's frame;
  /// in an optical frame above is -y.
  MarkerBuilder(const ModelBase& models, int most_triangles,
                const Eigen::Vector3d& up = -Eigen::Vector3d::UnitY());
  /// `only`: the one name that was looked for; markers of other names stay as they are. "": all.
  visualization_msgs::MarkerArray build(const std_msgs::Header& header,
                                        const std::vector<ObjectEstimate>& objects,
                                        const std::vector<int>& instances, const std::string& only = "");

 private:
  using Key = std::pair<std::string, int>;  // name, instance
  visualization_msgs::Marker shape(const std_msgs::Header& header, const ObjectEstimate& object) const;
  visualization_msgs::Marker label(const std_msgs::Header& header, const ObjectEstimate& object,
                                   int instance) const;

  const ModelBase& models_;
  int most_triangles_;
  Eigen::Vector3d up_;
  std::vector<Key> shown_;
};

}  // namespace monocular_eye_hand
