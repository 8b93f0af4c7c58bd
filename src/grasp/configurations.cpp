#include "configurations.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace monocular_eye_hand {
namespace {

bool same(const ArmConfiguration& a, const ArmConfiguration& b) {
  return std::tie(a.shoulder, a.elbow, a.wrist) == std::tie(b.shoulder, b.elbow, b.wrist);
}

double farthest(const JointVector& a, const JointVector& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// Of the solutions in this configuration the one nearest to `joints`.
const ArmSolution* nearest(const ArmSolutions& solutions, const ArmConfiguration& configuration,
                           const JointVector& joints) {
  const ArmSolution* best = nullptr;
  for (const ArmSolution& s : solutions)
    if (same(s.configuration, configuration) &&
        (!best || farthest(s.joints, joints) < farthest(best->joints, joints)))
      best = &s;
  return best;
}

}  // namespace

GraspConfigurations findConfigurations(const Puma560& arm, const Rigid3& pregrasp, const Rigid3& grasp,
                                       const Rigid3& lift, const JointVector& current,
                                       const GraspPlanOptions& options) {
  GraspConfigurations result;
  ArmSolutions at_grasp, at_pregrasp, at_lift;
  arm.inverse(grasp, current, &at_grasp);
  if (at_grasp.empty()) {
    result.reason = "the grasp is out of the arm's reach or limits";
    return result;
  }

  arm.inverse(pregrasp, current, &at_pregrasp);
  arm.inverse(lift, current, &at_lift);
  if (at_pregrasp.empty() || at_lift.empty()) {
    result.reason = std::string(at_pregrasp.empty() ? "the pre-grasp" : "the end of the lift") +
                    " is out of the arm's reach or limits";
    return result;
  }

  result.reason = "no configuration reaches pre-grasp, grasp and lift alike";
  std::vector<GraspConfiguration> found;
  for (const ArmSolution& g : at_grasp) {
    const ArmSolution* p = nearest(at_pregrasp, g.configuration, g.joints);
    const ArmSolution* l = nearest(at_lift, g.configuration, g.joints);
    if (!p || !l) continue;
    const double wrist = std::min({std::abs(std::sin(g.joints[4])), std::abs(std::sin(p->joints[4])),
                                   std::abs(std::sin(l->joints[4]))});
    if (wrist < options.min_wrist || farthest(p->joints, g.joints) > options.max_joint_step ||
        farthest(l->joints, g.joints) > options.max_joint_step) {
      result.refusal = GraspRefusal::kSingular;
      result.reason =
          "the configurations that reach it pass the wrist's singularity or turn a joint by more than "
          "max_joint_step";
      continue;
    }
    found.push_back({g.configuration, p->joints, g.joints, l->joints, farthest(p->joints, current)});
  }

  std::stable_sort(found.begin(), found.end(), [](const GraspConfiguration& a, const GraspConfiguration& b) {
    return a.travel < b.travel - 1e-9;
  });
  for (const GraspConfiguration& configuration : found) {
    const bool known = std::any_of(result.configurations.begin(), result.configurations.end(),
                                   [&](const GraspConfiguration& other) {
                                     return same(other.configuration, configuration.configuration);
                                   });
    if (!known) result.configurations.push_back(configuration);
  }
  return result;
}

}  // namespace monocular_eye_hand
