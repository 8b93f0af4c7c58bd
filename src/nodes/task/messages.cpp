#include "nodes/task/messages.h"

#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/conversion.h"
#include "nodes/eye_hand/conversion.h"

namespace monocular_eye_hand {
namespace {

uint8_t code(ObjectOutcome outcome) {
  switch (outcome) {
    case ObjectOutcome::kWaiting:
      return ClearedObject::WAITING;
    case ObjectOutcome::kCarried:
      return ClearedObject::CARRIED;
    case ObjectOutcome::kGone:
      return ClearedObject::GONE;
    case ObjectOutcome::kLeft:
      return ClearedObject::LEFT;
    case ObjectOutcome::kHeld:
      return ClearedObject::HELD;
    case ObjectOutcome::kDropped:
      return ClearedObject::DROPPED;
    case ObjectOutcome::kDoubt:
      return ClearedObject::DOUBT;
  }
  return ClearedObject::LEFT;
}

uint8_t code(TaskOutcome outcome) {
  switch (outcome) {
    case TaskOutcome::kCleared:
      return ClearFrameResult::CLEARED;
    case TaskOutcome::kLeftovers:
      return ClearFrameResult::LEFTOVERS;
    case TaskOutcome::kNoFrame:
      return ClearFrameResult::NO_FRAME;
    case TaskOutcome::kCancelled:
      return ClearFrameResult::CANCELLED;
    case TaskOutcome::kFault:
      return ClearFrameResult::FAULT;
  }
  return ClearFrameResult::FAULT;
}

JointVector fromArray(const boost::array<double, 6>& joints) {
  return Eigen::Map<const JointVector>(joints.data());
}

Matrix6d covarianceOf(const geometry_msgs::PoseWithCovariance& message) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.covariance.data());
}

void requireGraspOf(const MappedObject& asked, const std::string& base_frame, const GraspTarget& target) {
  if (target.name != asked.name || target.instance != asked.number)
    throw BadInput("eye_hand was asked for grasps of " + asked.name + " " + std::to_string(asked.number) +
                   " and answered with one of " + target.name + " " + std::to_string(target.instance));
  if (withoutSlash(target.header.frame_id) != base_frame)
    throw BadInput("eye_hand plans grasps in the frame '" + target.header.frame_id + "', the task in '" +
                   base_frame + "' (the parameters base_frame)");
}

}  // namespace

MappedObject fromMessage(const LocatedObject& message, const ModelBase& models) {
  MappedObject object;
  object.object = models.indexOf(message.name);
  if (object.object < 0)
    throw BadInput("eye_hand knows an object \"" + message.name + "\" that is not in the model base (" +
                   models.names() + "): both nodes must load the same file");
  object.name = message.name;
  object.number = message.instance;
  object.base_from_object = poseOf(message.pose.pose, "the pose of " + message.name);
  object.covariance = covarianceOf(message.pose);
  object.free_axis = message.free_axis;
  object.probability = message.probability;
  object.views = message.views;
  object.misses = message.misses;
  object.last_stamp = message.header.stamp.toSec();
  return object;
}

GraspCandidate fromMessage(const GraspTarget& message) {
  GraspCandidate grasp;
  grasp.base_from_pregrasp = poseOf(message.pregrasp, "the pregrasp pose of " + message.name);
  grasp.base_from_grasp = poseOf(message.grasp, "the grasp pose of " + message.name);
  grasp.base_from_lift = poseOf(message.retreat, "the retreat pose of " + message.name);
  grasp.part_width = message.width;
  grasp.opening = message.opening;
  grasp.approach = {message.approach.x, message.approach.y, message.approach.z};
  grasp.branch = branchOf(message.branch);
  grasp.pregrasp_joints = fromArray(message.pregrasp_joints);
  grasp.grasp_joints = fromArray(message.grasp_joints);
  grasp.lift_joints = fromArray(message.retreat_joints);
  grasp.free = message.free;
  grasp.needed = message.needed;
  grasp.quality = message.quality;
  grasp.source = message.reason;
  return grasp;
}

TaskGrasps fromMessage(const GraspTargetsResponse& response, const MappedObject& asked,
                       const std::string& base_frame) {
  TaskGrasps grasps;
  grasps.object = asked;
  grasps.plan.reason = response.text;
  grasps.plan.too_uncertain = response.status == GraspTargetsResponse::TOO_UNCERTAIN;
  if (response.status != GraspTargetsResponse::FOUND || response.targets.empty()) return grasps;

  const GraspTarget& first = response.targets.front();
  for (const GraspTarget& target : response.targets) {
    requireGraspOf(asked, base_frame, target);
    if (target.object != first.object)
      throw BadInput("eye_hand planned the grasps of " + asked.name + " " + std::to_string(asked.number) +
                     " for more than one pose of it");
    grasps.plan.candidates.push_back(fromMessage(target));
  }

  grasps.object.base_from_object = poseOf(first.object.pose, "the pose of " + first.name);
  grasps.object.covariance = covarianceOf(first.object);
  grasps.object.last_stamp = first.header.stamp.toSec();
  return grasps;
}

GraspTarget toMessage(const PlannedGrasp& planned, const std::string& base_frame) {
  const ros::Time seen(planned.object.last_stamp);
  return toMessage(toMessage(planned.object, seen, base_frame), planned.grasp);
}

ClearFrameResult toMessage(const TaskResult& result, const std::string& base_frame, double duration) {
  ClearFrameResult message;
  message.outcome = code(result.outcome);
  message.reason = result.reason;
  for (const TaskObject& object : result.objects) {
    ClearedObject cleared;
    cleared.object = toMessage(object.object, ros::Time(object.object.last_stamp), base_frame);
    cleared.outcome = code(object.outcome);
    cleared.reason = object.reason;
    cleared.picks = object.picks;
    cleared.near_looks = object.near_looks;
    message.objects.push_back(cleared);
  }
  message.rounds = result.rounds;
  message.duration = duration;
  return message;
}

ClearFrameFeedback toMessage(const TaskFeedback& feedback) {
  ClearFrameFeedback message;
  message.stage = toString(feedback.stage);
  message.object = feedback.object;
  message.round = feedback.round;
  message.carried = feedback.carried;
  message.left = feedback.left;
  message.text = feedback.text;
  return message;
}

}  // namespace monocular_eye_hand
