#include "monocular_eye_hand/grasp/grasp_advisor.h"

namespace monocular_eye_hand {
namespace {

GraspAnswer noGrasps(GraspStatus status, const std::string& text) {
  GraspAnswer answer;
  answer.status = status;
  answer.text = text;
  return answer;
}

std::string label(const MappedObject& object) { return object.name + " " + std::to_string(object.number); }

std::string knownText(const MapState& known) {
  std::string text;
  for (const MappedObject& object : known.objects) text += (text.empty() ? "" : ", ") + label(object);
  return text.empty() ? "nothing is known now" : "known now: " + text;
}

std::string notReadyText(const MapState& known, const ArmNow& arm) {
  if (known.stamp) return arm.problem;
  return known.refused.empty() ? "no view was received yet: is the recognizer running, with a camera?"
                               : "no view could be used yet; the last one: " + known.refused;
}

GraspAnswer found(const MapState& known, const ObjectGraspPlan& best) {
  const std::vector<GraspCandidate>& candidates = best.plan.candidates;
  GraspAnswer answer;
  answer.status = GraspStatus::kFound;
  answer.text = label(known.objects[best.index]) + ": " + std::to_string(candidates.size()) + " grasps";
  answer.index = best.index;
  answer.candidates = candidates;
  return answer;
}

GraspAnswer noneFound(const MapState& known, const std::vector<ObjectGraspPlan>& plans) {
  bool too_uncertain = false;
  std::string reasons;
  for (const ObjectGraspPlan& one : plans) {
    too_uncertain = too_uncertain || one.plan.too_uncertain;
    reasons += (reasons.empty() ? "" : "; ") + label(known.objects[one.index]) + ": " + one.plan.reason;
  }
  return noGrasps(too_uncertain ? GraspStatus::kTooUncertain : GraspStatus::kNoGrasp, reasons);
}

}  // namespace

GraspAdvisor::GraspAdvisor(const ModelBase& models, const GraspingOptions& options, const Puma560& arm,
                           const Rigid3& tool0_from_tcp)
    : models_(models),
      table_(options.table),
      tool0_from_tcp_(tool0_from_tcp),
      grasps_(&models, &arm, tool0_from_tcp, options.gripper, options.sampling, options.grasp) {}

std::optional<double> GraspAdvisor::tableHeight(const MapState& known, double untold) const {
  if (!table_) return std::nullopt;
  return known.table_height.value_or(untold);
}

GraspAnswer GraspAdvisor::answer(const std::string& name, int number, const MapState& known,
                                 const ArmNow& arm, double table_height) const {
  const int wanted = models_.indexOf(name);
  if (wanted < 0)
    return noGrasps(GraspStatus::kUnknownName,
                    "no object is named '" + name + "'; known: " + models_.names());
  const ModelGrasps& anywhere = grasps_.ofModel(wanted);
  if (anywhere.grasps.empty()) return noGrasps(GraspStatus::kNoGrasp, anywhere.reason);
  if (!known.stamp || !arm.problem.empty()) return noGrasps(GraspStatus::kNotReady, notReadyText(known, arm));

  const std::vector<ObjectGraspPlan> plans =
      grasps_.plans(known.objects, wanted, number, tableHeight(known, table_height), arm.joints);
  if (plans.empty()) {
    const std::string which = number < 0 ? "" : " " + std::to_string(number);
    return noGrasps(GraspStatus::kNotKnown, "no " + name + which + " is known; " + knownText(known));
  }

  const ObjectGraspPlan* best = bestOf(plans);
  return best ? found(known, *best) : noneFound(known, plans);
}

std::vector<BestGrasp> GraspAdvisor::best(const MapState& known, const ArmNow& arm,
                                          double table_height) const {
  std::vector<BestGrasp> all;
  for (size_t k = 0; k < known.objects.size(); ++k) {
    if (!grasps_.mayGrasp(known.objects[k].object)) continue;
    BestGrasp best{k, std::nullopt, arm.problem};
    if (arm.problem.empty()) {
      const GraspPlan plan = grasps_.plan(known.objects, k, tableHeight(known, table_height), arm.joints);
      best.reason = plan.reason;
      if (!plan.candidates.empty()) best.grasp = plan.candidates.front();
    }
    all.push_back(std::move(best));
  }
  return all;
}

}  // namespace monocular_eye_hand
