#include "nodes/task/messages.h"

#include <fmt/format.h>

#include <array>

#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/conversion.h"
#include "nodes/eye_hand/messages.h"

namespace monocular_eye_hand {
namespace {

uint8_t codeOf(ObjectOutcome outcome) {
  using C = ClearedObject;
  constexpr std::array<uint8_t, 7> kCodes{C::WAITING, C::CARRIED, C::GONE, C::LEFT,
                                          C::HELD,    C::DROPPED, C::DOUBT};
  return kCodes.at(size_t(outcome));
}

uint8_t codeOf(TaskOutcome outcome) {
  using R = ClearFrameResult;
  constexpr std::array<uint8_t, 5> kCodes{R::CLEARED, R::LEFTOVERS, R::NO_FRAME, R::CANCELLED, R::FAULT};
  return kCodes.at(size_t(outcome));
}

JointVector fromArray(const boost::array<double, 6>& joints) {
  return Eigen::Map<const JointVector>(joints.data());
}

void requireGraspOf(const MappedObject& asked, const std::string& base_frame, const GraspTarget& target) {
  if (target.name != asked.name || target.instance != asked.number)
    throw BadInput(fmt::format("eye_hand was asked for grasps of {} {} and answered with one of {} {}",
                               asked.name, asked.number, target.name, target.instance));
  if (withoutSlash(target.header.frame_id) != base_frame)
    throw BadInput(
        fmt::format("eye_hand plans grasps in the frame '{}', the task in '{}' (the parameters base_frame)",
                    target.header.frame_id, base_frame));
}

}  // namespace

MappedObject fromMessage(const LocatedObject& message, const ModelBase& models) {
  MappedObject object;
  object.object = models.indexOf(message.name);
  if (object.object < 0)
    throw BadInput(
        fmt::format("eye_hand knows an object \"{}\" that is not in the model base ({}): both nodes must "
                    "load the same file",
                    message.name, models.names()));
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
      throw BadInput(fmt::format("eye_hand planned the grasps of {} {} for more than one pose of it",
                                 asked.name, asked.number));
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
  message.outcome = codeOf(result.outcome);
  message.reason = result.reason;
  for (const TaskObject& object : result.objects) {
    ClearedObject cleared;
    cleared.object = toMessage(object.object, ros::Time(object.object.last_stamp), base_frame);
    cleared.outcome = codeOf(object.outcome);
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
