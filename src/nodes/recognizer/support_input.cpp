#include "nodes/recognizer/support_input.h"

#include <ros/ros.h>

#include "nodes/common/conversion.h"

namespace monocular_eye_hand {
namespace {

constexpr double kPoll = 0.005;      // while waiting for a transform [s]
constexpr double kWarnAgain = 10.0;  // that there is none [s]

}  // namespace

SupportInput::SupportInput(const SupportParameters& parameters) : parameters_(parameters) {
  if (!parameters_.frame.empty()) transforms_.emplace();
}

void SupportInput::restart() {
  if (transforms_) transforms_->buffer.clear();
}

std::optional<SupportPlane> SupportInput::at(const std_msgs::Header& image) {
  if (!transforms_) return std::nullopt;
  // tf's own wait ends by ROS time, which may stand.
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(parameters_.wait);
  while (!transforms_->buffer.canTransform(image.frame_id, parameters_.frame, image.stamp) &&
         ros::WallTime::now() < end && ros::ok())
    ros::WallDuration(kPoll).sleep();

  try {
    const auto found = transforms_->buffer.lookupTransform(image.frame_id, parameters_.frame, image.stamp);
    return supportPlane(fromTransform(found.transform), parameters_.height, parameters_.tolerance);
  } catch (const tf2::TransformException& e) {
    ROS_WARN_THROTTLE(kWarnAgain,
                      "the support plane is not known, recognition goes on without it: no transform "
                      "from %s to %s at the image's stamp: %s",
                      parameters_.frame.c_str(), image.frame_id.c_str(), e.what());
    return std::nullopt;
  }
}

}  // namespace monocular_eye_hand
