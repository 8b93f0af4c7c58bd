#include "nodes/eye_hand/conversion.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/conversion.h"

namespace monocular_eye_hand {
namespace {

constexpr double kUnit = 1e-3;  // a quaternion's length may be off by so much

SeenObject toSeenObject(const RecognizedObject& message, const ModelBase& models) {
  SeenObject seen;
  seen.object = models.indexOf(message.name);
  if (seen.object < 0)
    throw BadInput("object '" + message.name + "' is not in the model base (" + models.names() +
                   "): recognizer and eye_hand must load the same one");

  const geometry_msgs::Quaternion& q = message.pose.pose.orientation;
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(std::abs(length - 1) <= kUnit)) {
    std::ostringstream text;
    text << "the orientation of " << message.name << " has length " << length << ", not 1";
    throw BadInput(text.str());
  }

  seen.camera_from_object = fromPose(message.pose.pose);
  requirePose(seen.camera_from_object, ("the pose of " + message.name).c_str());
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col < 6; ++col)
      seen.covariance(row, col) = message.pose.covariance[size_t(row * 6 + col)];
  requireCovariance(seen.covariance, ("the covariance of " + message.name).c_str());
  seen.probability = message.probability;
  return seen;
}

void copyJoints(const JointVector& joints, boost::array<double, 6>* field) {
  std::copy(joints.data(), joints.data() + 6, field->begin());
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

}  // namespace monocular_eye_hand
