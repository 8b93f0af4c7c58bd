#include "nodes/grasp_advisor.h"

#include "nodes/eye_hand_conversion.h"

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

}  // namespace

GraspAdvisor::GraspAdvisor(const ModelBase& models, const EyeHandParameters& parameters, const Puma560& arm,
                           const Rigid3& tool0_from_tcp)
    : models_(models), parameters_(parameters), arm_(arm), tool0_from_tcp_(tool0_from_tcp) {
  for (const KnownObject& known : models.objects)
    grasps_.push_back(graspsOf(known, parameters.gripper, parameters.sampling));
}

bool GraspAdvisor::mayGrasp(int object) const {
  const Handling& handling = models_.objects.at(size_t(object)).handling;
  return handling.grasp && !handling.obstacle;
}

GraspPlan GraspAdvisor::plan(const KnownObjects& known, size_t index, const JointVector& current) const {
  const MappedObject& object = known.objects[index];
  GraspScene scene;
  scene.table = parameters_.table;
  scene.table_height = known.table_height.value_or(parameters_.table_height);
  for (size_t k = 0; k < known.objects.size(); ++k)
    if (k != index)
      scene.obstacles.push_back(
          {&models_.objects[size_t(known.objects[k].object)].model, known.objects[k].base_from_object});
  return planGrasps(
      {&models_.objects[size_t(object.object)].model, object.base_from_object, object.covariance},
      grasps_[size_t(object.object)], scene, parameters_.gripper, arm_, tool0_from_tcp_, current,
      parameters_.grasp);
}

Response GraspAdvisor::answer(const GraspTargets::Request& request, const KnownObjects& known,
                              const ArmNow& arm) const {
  const int wanted = models_.indexOf(request.name);
  if (wanted < 0)
    return reply(Response::UNKNOWN_NAME,
                 "no object is named '" + request.name + "'; known: " + models_.names());
  if (grasps_[size_t(wanted)].grasps.empty())  // wherever it is
    return reply(Response::NO_GRASP, grasps_[size_t(wanted)].reason);
  if (known.stamp.isZero() || !arm.problem.empty())
    return reply(Response::NOT_READY, notReadyText(known, arm));

  bool seen = false, too_uncertain = false;
  Response best = reply(Response::NO_GRASP, "");
  std::string reasons;
  for (size_t k = 0; k < known.objects.size(); ++k) {
    if (known.objects[k].object != wanted) continue;
    if (request.instance >= 0 && known.objects[k].number != request.instance) continue;
    seen = true;
    const GraspPlan found = plan(known, k, arm.joints);
    if (found.candidates.empty()) {
      too_uncertain = too_uncertain || found.too_uncertain;
      reasons += (reasons.empty() ? "" : "; ") + label(known.messages[k]) + ": " + found.reason;
      continue;
    }
    if (!best.targets.empty() && best.targets.front().quality >= found.candidates.front().quality) continue;
    best = reply(Response::FOUND,
                 label(known.messages[k]) + ": " + std::to_string(found.candidates.size()) + " grasps");
    for (const GraspCandidate& grasp : found.candidates)
      best.targets.push_back(toMessage(known.messages[k], grasp));
  }

  if (!seen) {
    const std::string which = request.instance < 0 ? "" : " " + std::to_string(request.instance);
    return reply(Response::NOT_KNOWN, "no " + request.name + which + " is known; " + knownText(known));
  }
  if (!best.targets.empty()) return best;
  return reply(too_uncertain ? Response::TOO_UNCERTAIN : Response::NO_GRASP, reasons);
}

GraspTargetArray GraspAdvisor::best(const KnownObjects& known, const ArmNow& arm) const {
  GraspTargetArray array;
  array.header.stamp = known.stamp;
  array.header.frame_id = parameters_.base_frame;
  for (size_t k = 0; k < known.objects.size(); ++k) {
    if (!mayGrasp(known.objects[k].object)) continue;
    if (!arm.problem.empty()) {
      array.targets.push_back(noGrasp(known.messages[k], arm.problem));
      continue;
    }
    const GraspPlan found = plan(known, k, arm.joints);
    array.targets.push_back(found.candidates.empty()
                                ? noGrasp(known.messages[k], found.reason)
                                : toMessage(known.messages[k], found.candidates.front()));
  }
  return array;
}

}  // namespace monocular_eye_hand
