#include "nodes/common/conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

uint8_t codeOf(Decision decision) {
  if (decision == Decision::kAccepted) return RecognizedObject::ACCEPTED;
  return decision == Decision::kAmbiguous ? RecognizedObject::AMBIGUOUS : RecognizedObject::REJECTED;
}

// RegionOfInterest is unsigned: a box that begins outside the image begins at 0.
sensor_msgs::RegionOfInterest toRegion(const cv::Rect& box) {
  const int x = std::max(0, box.x), y = std::max(0, box.y);
  sensor_msgs::RegionOfInterest region;
  region.x_offset = uint32_t(x);
  region.y_offset = uint32_t(y);
  region.width = uint32_t(std::max(0, box.x + box.width - x));
  region.height = uint32_t(std::max(0, box.y + box.height - y));
  return region;
}

}  // namespace

std::string withoutSlash(const std::string& frame) {
  return frame.substr(std::min(frame.find_first_not_of('/'), frame.size()));
}

geometry_msgs::Point toPoint(const Eigen::Vector3d& p) {
  geometry_msgs::Point point;
  point.x = p.x();
  point.y = p.y();
  point.z = p.z();
  return point;
}

geometry_msgs::Pose toPose(const Rigid3& a_from_b) {
  const Eigen::Quaterniond q = a_from_b.quaternion().normalized();
  geometry_msgs::Pose pose;
  pose.position = toPoint(a_from_b.translation);
  pose.orientation.x = q.x();
  pose.orientation.y = q.y();
  pose.orientation.z = q.z();
  pose.orientation.w = q.w();
  return pose;
}

Rigid3 fromPose(const geometry_msgs::Pose& pose) {
  const Eigen::Quaterniond q(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  return {q.normalized().toRotationMatrix(), {pose.position.x, pose.position.y, pose.position.z}};
}

Rigid3 fromTransform(const geometry_msgs::Transform& transform) {
  geometry_msgs::Pose pose;
  pose.position.x = transform.translation.x;
  pose.position.y = transform.translation.y;
  pose.position.z = transform.translation.z;
  pose.orientation = transform.rotation;
  return fromPose(pose);
}

Rigid3 poseOf(const geometry_msgs::Pose& pose, const std::string& what) {
  const auto& q = pose.orientation;
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  const double sum = pose.position.x + pose.position.y + pose.position.z + length;
  if (!std::isfinite(sum)) throw BadInput(what + " is not finite");
  if (std::abs(length - 1) > 0.01)
    throw BadInput(fmt::format("{}: its quaternion has length {:.6f} and must have 1", what, length));
  return fromPose(pose);
}

geometry_msgs::PoseWithCovariance toPose(const Rigid3& a_from_b, const Matrix6d& covariance) {
  geometry_msgs::PoseWithCovariance pose;
  pose.pose = toPose(a_from_b);
  Eigen::Map<RowMajor6d>(pose.covariance.data()) = covariance;
  return pose;
}

Matrix6d covarianceOf(const geometry_msgs::PoseWithCovariance& message) {
  return Eigen::Map<const RowMajor6d>(message.covariance.data());
}

geometry_msgs::TransformStamped toTransform(const std_msgs::Header& header, const std::string& child,
                                            const Rigid3& a_from_b) {
  const geometry_msgs::Pose pose = toPose(a_from_b);
  geometry_msgs::TransformStamped transform;
  transform.header = header;
  transform.child_frame_id = child;
  transform.transform.translation.x = pose.position.x;
  transform.transform.translation.y = pose.position.y;
  transform.transform.translation.z = pose.position.z;
  transform.transform.rotation = pose.orientation;
  return transform;
}

std::string objectFrame(const std::string& prefix, const std::string& name, int number) {
  std::string frame = prefix + name;
  for (char& c : frame)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-' && c != '.' && c != '/') c = '_';
  return fmt::format("{}_{}", frame, number);
}

RecognizedObject toMessage(const std_msgs::Header& header, const ObjectEstimate& object, int instance,
                           const ModelBase& models) {
  RecognizedObject message;
  message.header = header;
  message.name = object.name;
  message.instance = instance;
  message.pose = toPose(object.camera_from_object, object.covariance);
  message.plausibility = object.plausibility;
  message.reliability = object.reliability;
  message.probability = object.probability;
  message.decision = codeOf(object.decision);

  for (const Alternative& alternative : object.alternatives) {
    monocular_eye_hand::PoseAlternative entry;
    entry.name = models.objects.at(size_t(alternative.object)).model.name;
    entry.pose = toPose(alternative.camera_from_object);
    entry.probability = alternative.probability;
    message.alternatives.push_back(entry);
  }

  message.matched_features = object.matched_features;
  message.expected_features = object.expected_features;
  message.bounding_box = toRegion(object.bounding_box);
  message.symmetry = object.symmetry;
  message.free_axis = object.free_axis;
  message.reason = object.reason;
  return message;
}

}  // namespace monocular_eye_hand
