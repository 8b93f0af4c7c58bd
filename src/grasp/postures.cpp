#include "postures.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace monocular_eye_hand {
namespace {

bool same(const Branch& a, const Branch& b) {
  return std::tie(a.shoulder, a.elbow, a.wrist) == std::tie(b.shoulder, b.elbow, b.wrist);
}

double farthest(const JointVector& a, const JointVector& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// Of the solutions of this branch the one nearest to `joints`.
const ArmSolution* nearest(const ArmSolutions& solutions, const Branch& branch, const JointVector& joints) {
  const ArmSolution* best = nullptr;
  for (const ArmSolution& s : solutions)
    if (same(s.branch, branch) && (!best || farthest(s.joints, joints) < farthest(best->joints, joints)))
      best = &s;
  return best;
}

}  // namespace

Postures findPostures(const Puma560& arm, const Rigid3& pregrasp, const Rigid3& grasp, const Rigid3& lift,
                      const JointVector& current, const GraspPlanOptions& options) {
  Postures result;
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

  result.reason = "no posture reaches pre-grasp, grasp and lift alike";
  std::vector<Posture> found;
  for (const ArmSolution& g : at_grasp) {
    const ArmSolution* p = nearest(at_pregrasp, g.branch, g.joints);
    const ArmSolution* l = nearest(at_lift, g.branch, g.joints);
    if (!p || !l) continue;
    const double wrist = std::min({std::abs(std::sin(g.joints[4])), std::abs(std::sin(p->joints[4])),
                                   std::abs(std::sin(l->joints[4]))});
    if (wrist < options.min_wrist || farthest(p->joints, g.joints) > options.max_joint_step ||
        farthest(l->joints, g.joints) > options.max_joint_step) {
      result.refusal = GraspRefusal::kSingular;
      result.reason =
          "the postures that reach it pass the wrist's singularity or turn a joint by more than "
          "max_joint_step";
      continue;
    }
    found.push_back({g.branch, p->joints, g.joints, l->joints, farthest(p->joints, current)});
  }

  std::stable_sort(found.begin(), found.end(),
                   [](const Posture& a, const Posture& b) { return a.travel < b.travel - 1e-9; });
  for (const Posture& posture : found) {
    const bool known = std::any_of(result.postures.begin(), result.postures.end(),
                                   [&](const Posture& other) { return same(other.branch, posture.branch); });
    if (!known) result.postures.push_back(posture);
  }
  return result;
}

}  // namespace monocular_eye_hand
