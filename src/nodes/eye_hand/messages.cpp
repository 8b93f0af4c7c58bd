#include "nodes/eye_hand/messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/conversion.h"
#include "nodes/common/stamps.h"

namespace monocular_eye_hand {
namespace {

using visualization_msgs::Marker;

constexpr double kUnit = 1e-3;  // a quaternion's length may be off by so much

SeenObject toSeenObject(const RecognizedObject& message, const ModelBase& models) {
  SeenObject seen;
  seen.object = models.indexOf(message.name);
  if (seen.object < 0)
    throw BadInput(fmt::format(
        "object '{}' is not in the model base ({}): recognizer and eye_hand must load the same one",
        message.name, models.names()));

  const geometry_msgs::Quaternion& q = message.pose.pose.orientation;
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(std::abs(length - 1) <= kUnit))
    throw BadInput(fmt::format("the orientation of {} has length {:.6g}, not 1", message.name, length));

  seen.camera_from_object = fromPose(message.pose.pose);
  requirePose(seen.camera_from_object, ("the pose of " + message.name).c_str());
  seen.covariance = covarianceOf(message.pose);
  requireCovariance(seen.covariance, ("the covariance of " + message.name).c_str());
  seen.probability = message.probability;
  return seen;
}

void copyJoints(const JointVector& joints, boost::array<double, 6>* field) {
  std::copy(joints.data(), joints.data() + 6, field->begin());
}

uint8_t codeOf(GraspStatus status) {
  using Response = GraspTargets::Response;
  constexpr std::array<uint8_t, 6> kCodes{Response::FOUND,     Response::UNKNOWN_NAME,
                                          Response::NOT_READY, Response::NOT_KNOWN,
                                          Response::NO_GRASP,  Response::TOO_UNCERTAIN};
  return kCodes.at(size_t(status));
}

Marker arrow(const GraspTarget& target, const std_msgs::Header& header) {
  Marker marker;
  marker.header = header;
  marker.type = Marker::ARROW;
  marker.action = Marker::ADD;
  marker.ns = target.name + "/grasp";
  marker.id = target.instance;
  marker.pose.orientation.w = 1;
  marker.points = {target.pregrasp.position, target.grasp.position};
  // Shaft, head and the head's length [m].
  marker.scale.x = 0.006;
  marker.scale.y = 0.014;
  marker.scale.z = 0.02;
  marker.color = toColour(1 - target.quality, target.quality, 0);  // the better the grasp the greener
  marker.lifetime = ros::Duration(kRepeatedLifetime);
  return marker;
}

}  // namespace

std::vector<SeenObject> toSeenObjects(const RecognizedObjectArray& array, const ModelBase& models) {
  std::vector<SeenObject> objects;
  for (const RecognizedObject& message : array.objects) objects.push_back(toSeenObject(message, models));
  return objects;
}

bool isComplete(const RecognizedObjectArray& array) { return !array.truncated && !array.budget_spent; }

LocatedObject toMessage(const MappedObject& object, const ros::Time& stamp, const std::string& base_frame) {
  LocatedObject message;
  message.header.stamp = stamp;
  message.header.frame_id = base_frame;
  message.name = object.name;
  message.instance = object.number;
  message.pose = toPose(object.base_from_object, object.covariance);
  message.probability = object.probability;
  message.free_axis = object.free_axis;
  message.views = object.views;
  message.misses = object.misses;
  return message;
}

std::vector<LocatedObject> toMessages(const KnownObjects& known, const std::string& base_frame) {
  std::vector<LocatedObject> messages;
  for (size_t k = 0; k < known.map.objects.size(); ++k)
    messages.push_back(toMessage(known.map.objects[k], toTime(known.stamps.at(k)), base_frame));
  return messages;
}

GraspTarget toMessage(const LocatedObject& object, const GraspCandidate& grasp) {
  GraspTarget target = noGrasp(object, grasp.source);
  target.feasible = true;
  target.pregrasp = toPose(grasp.base_from_pregrasp);
  target.grasp = toPose(grasp.base_from_grasp);
  target.retreat = toPose(grasp.base_from_lift);
  target.approach.x = grasp.approach.x();
  target.approach.y = grasp.approach.y();
  target.approach.z = grasp.approach.z();

  target.width = grasp.part_width;
  target.opening = grasp.opening;
  target.branch = toString(grasp.branch);
  copyJoints(grasp.pregrasp_joints, &target.pregrasp_joints);
  copyJoints(grasp.grasp_joints, &target.grasp_joints);
  copyJoints(grasp.lift_joints, &target.retreat_joints);

  target.free = grasp.free;
  target.needed = grasp.needed;
  target.quality = grasp.quality;
  return target;
}

GraspTarget noGrasp(const LocatedObject& object, const std::string& reason) {
  GraspTarget target;
  target.header = object.header;
  target.name = object.name;
  target.instance = object.instance;
  target.object = object.pose;
  target.reason = reason;
  return target;
}

GraspTargets::Response toMessage(const GraspAnswer& answer, const KnownObjects& known,
                                 const std::string& base_frame) {
  GraspTargets::Response response;
  response.status = codeOf(answer.status);
  response.text = answer.text;
  if (!answer.index) return response;
  const LocatedObject object = toMessages(known, base_frame).at(*answer.index);
  for (const GraspCandidate& grasp : answer.candidates) response.targets.push_back(toMessage(object, grasp));
  return response;
}

GraspTargetArray toMessage(const std::vector<BestGrasp>& best, const KnownObjects& known,
                           const std::string& base_frame) {
  const std::vector<LocatedObject> objects = toMessages(known, base_frame);
  GraspTargetArray array;
  array.header.stamp = toTime(known.stamp);
  array.header.frame_id = base_frame;
  for (const BestGrasp& one : best) {
    const LocatedObject& object = objects.at(one.index);
    array.targets.push_back(one.grasp ? toMessage(object, *one.grasp) : noGrasp(object, one.reason));
  }
  return array;
}

visualization_msgs::MarkerArray GraspArrows::build(const GraspTargetArray& grasps) {
  std_msgs::Header header;  // stamp 0, as the objects' markers
  header.frame_id = grasps.header.frame_id;

  visualization_msgs::MarkerArray array;
  for (const GraspTarget& target : grasps.targets)
    if (target.feasible) array.markers.push_back(arrow(target, header));
  shown_.deleteOthers(
      header, [](const std::string&) { return false; }, &array);
  return array;
}

}  // namespace monocular_eye_hand
