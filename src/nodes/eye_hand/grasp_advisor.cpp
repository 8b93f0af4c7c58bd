#include "nodes/eye_hand/grasp_advisor.h"

#include <vector>

#include "nodes/eye_hand/conversion.h"

namespace monocular_eye_hand {
namespace {

using Response = GraspTargets::Response;

Response reply(uint8_t status, const std::string& text) {
  Response response;
  response.status = status;
  response.text = text;
  return response;
}

std::string label(const LocatedObject& object) { return object.name + " " + std::to_string(object.instance); }

std::string knownText(const KnownObjects& known) {
  std::string text;
  for (const LocatedObject& object : known.messages) text += (text.empty() ? "" : ", ") + label(object);
  return text.empty() ? "nothing is known now" : "known now: " + text;
}

std::string notReadyText(const KnownObjects& known, const ArmNow& arm) {
  if (known.stamp.isZero())
    return known.refused.empty() ? "no view was received yet: is the recognizer running, with a camera?"
                                 : "no view could be used yet; the last one: " + known.refused;
  return arm.problem;
}

Response foundReply(const LocatedObject& object, const GraspPlan& plan) {
  Response response =
      reply(Response::FOUND, label(object) + ": " + std::to_string(plan.candidates.size()) + " grasps");
  for (const GraspCandidate& grasp : plan.candidates) response.targets.push_back(toMessage(object, grasp));
  return response;
}

Response noGraspReply(const KnownObjects& known, const std::vector<ObjectGraspPlan>& plans) {
  bool too_uncertain = false;
  std::string reasons;
  for (const ObjectGraspPlan& one : plans) {
    too_uncertain = too_uncertain || one.plan.too_uncertain;
    reasons += (reasons.empty() ? "" : "; ") + label(known.messages[one.index]) + ": " + one.plan.reason;
  }
  return reply(too_uncertain ? Response::TOO_UNCERTAIN : Response::NO_GRASP, reasons);
}

}  // namespace

GraspAdvisor::GraspAdvisor(const ModelBase& models, const EyeHandParameters& parameters, const Puma560& arm,
                           const Rigid3& tool0_from_tcp)
    : models_(models),
      parameters_(parameters),
      tool0_from_tcp_(tool0_from_tcp),
      grasps_(&models, &arm, tool0_from_tcp, parameters.gripper, parameters.sampling, parameters.grasp) {}

std::optional<double> GraspAdvisor::tableHeight(const KnownObjects& known) const {
  if (!parameters_.table) return std::nullopt;
  return known.table_height.value_or(parameters_.table_height);
}

Response GraspAdvisor::answer(const GraspTargets::Request& request, const KnownObjects& known,
                              const ArmNow& arm) const {
  const int wanted = models_.indexOf(request.name);
  if (wanted < 0)
    return reply(Response::UNKNOWN_NAME,
                 "no object is named '" + request.name + "'; known: " + models_.names());
  const ModelGrasps& anywhere = grasps_.ofModel(wanted);
  if (anywhere.grasps.empty()) return reply(Response::NO_GRASP, anywhere.reason);
  if (known.stamp.isZero() || !arm.problem.empty())
    return reply(Response::NOT_READY, notReadyText(known, arm));

  const std::vector<ObjectGraspPlan> plans =
      grasps_.plans(known.objects, wanted, request.instance, tableHeight(known), arm.joints);
  if (plans.empty()) {
    const std::string which = request.instance < 0 ? "" : " " + std::to_string(request.instance);
    return reply(Response::NOT_KNOWN, "no " + request.name + which + " is known; " + knownText(known));
  }

  const ObjectGraspPlan* best = bestOf(plans);
  return best ? foundReply(known.messages[best->index], best->plan) : noGraspReply(known, plans);
}

GraspTargetArray GraspAdvisor::best(const KnownObjects& known, const ArmNow& arm) const {
  GraspTargetArray array;
  array.header.stamp = known.stamp;
  array.header.frame_id = parameters_.base_frame;
  for (size_t k = 0; k < known.objects.size(); ++k) {
    if (!grasps_.mayGrasp(known.objects[k].object)) continue;
    if (!arm.problem.empty()) {
      array.targets.push_back(noGrasp(known.messages[k], arm.problem));
      continue;
    }
    const GraspPlan found = grasps_.plan(known.objects, k, tableHeight(known), arm.joints);
    array.targets.push_back(found.candidates.empty()
                                ? noGrasp(known.messages[k], found.reason)
                                : toMessage(known.messages[k], found.candidates.front()));
  }
  return array;
}

}  // namespace monocular_eye_hand
