#pragma once
#include <std_msgs/Header.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <optional>
#include <string>

#include "monocular_eye_hand/parameters/recognizer.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// The plane that the parts stand on, as a camera sees it: from tf.
class SupportInput {
 public:
  explicit SupportInput(const SupportParameters& parameters);

  /// In the axes of the image's frame at its stamp; none when no plane is wanted, and when tf does not tell
  /// where it is, which is logged. Waits for a transform that is late, as long as the parameter `wait` says.
  std::optional<SupportPlane> at(const std_msgs::Header& image);
  /// Stamps start again: what was known of tf is forgotten.
  void restart();

 private:
  struct Transforms {
    tf2_ros::Buffer buffer;
    tf2_ros::TransformListener listener{buffer};
  };

  const SupportParameters parameters_;
  std::optional<Transforms> transforms_;  // only when a plane is wanted
};

}  // namespace monocular_eye_hand
