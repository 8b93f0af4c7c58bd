#include "monocular_eye_hand/grasp/plan_grasps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "boxes.h"
#include "clearance.h"
#include "configurations.h"
#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/equal_poses.h"
#include "monocular_eye_hand/model/free_turns.h"

namespace monocular_eye_hand {
namespace {

constexpr int kRules = int(GraspRefusal::kSingular) + 1;

std::string rounded(double value) { return fmt::format("{:g}", std::round(10 * value) / 10); }

/// The motions that leave the object as it is: discrete ones, times `steps` rotations about a free axis.
std::vector<Rigid3> symmetricCopies(const ObjectModel& model, int steps) {
  std::vector<Rigid3> copies;
  for (const Rigid3& s : model.symmetries.discrete) {
    if (!model.symmetries.axis) {
      copies.push_back(s);
      continue;
    }
    for (int k = 0; k < steps; ++k)
      copies.push_back(rotationAbout(*model.symmetries.axis, 2 * M_PI * k / steps) * s);
  }
  return copies;
}

/// Goes through the rules for one grasp after the other and keeps count of the refusals.
class Planner {
 public:
  Planner(const GraspObject& object, const GraspScene& scene, const GripperOptions& gripper,
          const Puma560& arm, const Rigid3& tool0_from_tcp, const JointVector& current,
          const GraspPlanOptions& options)
      : object_(object),
        scene_(scene),
        gripper_(gripper),
        arm_(arm),
        tcp_from_tool0_(tool0_from_tcp.inverse()),
        current_(current),
        options_(options),
        held_(conditionedOnFreeAxis(*object.model, object.base_from_object, object.covariance)) {
    miss_.fill(std::numeric_limits<double>::max());
  }

  void tryAll(const ModelGrasps& grasps) {
    Rigid3 half_turn;  // the gripper is the same turned by half about z
    half_turn.rotation.diagonal() << -1, -1, 1;
    const std::vector<Rigid3> copies = symmetricCopies(*object_.model, options_.rotation_steps);
    for (size_t k = 0; k < grasps.grasps.size(); ++k) {
      for (const Rigid3& copy : copies) {
        const Rigid3 object_from_tcp = copy * grasps.grasps[k].object_from_tcp;
        tryGrasp(grasps.grasps[k], int(k), object_from_tcp);
        tryGrasp(grasps.grasps[k], int(k), object_from_tcp * half_turn);
      }
    }
  }

  void tryGrasp(const ModelGrasp& grasp, int index, const Rigid3& object_from_tcp) {
    GraspCandidate c;
    c.base_from_grasp = object_.base_from_object * object_from_tcp;
    c.approach = c.base_from_grasp.rotation.col(2);
    c.part_width = grasp.width;
    c.model_grasp = index;
    c.source = grasp.source;
    const double tilt = std::acos(std::clamp(-c.approach.z(), -1.0, 1.0));
    if (tilt > options_.max_tilt)
      return refuse(GraspRefusal::kFromBelow, tilt,
                    "the approach is tilted by " + rounded(tilt * 180 / M_PI) + " degrees, more than " +
                        rounded(options_.max_tilt * 180 / M_PI));

    const ClearanceNeed need =
        clearanceNeed(object_.base_from_object, held_, c.base_from_grasp, c.part_width, gripper_, options_);
    const double wanted = std::max(need.closing, options_.preferred_clearance);
    c.opening = std::min(gripper_.opening_max, c.part_width + 2 * wanted);
    c.free = (c.opening - c.part_width) / 2;
    c.needed = need.closing;
    if (!aboveTable(c)) return;
    if (!need.refusal.empty()) return refuse(GraspRefusal::kClearance, need.shortfall, need.refusal);
    if (!clear(c, need, object_from_tcp)) return;

    c.base_from_pregrasp = c.base_from_lift = c.base_from_grasp;
    c.base_from_pregrasp.translation -= options_.approach_distance * c.approach;
    c.base_from_lift.translation.z() += options_.lift_distance;
    const GraspConfigurations configurations =
        findConfigurations(arm_, c.base_from_pregrasp * tcp_from_tool0_, c.base_from_grasp * tcp_from_tool0_,
                           c.base_from_lift * tcp_from_tool0_, current_, options_);
    if (configurations.configurations.empty())
      return refuse(configurations.refusal, 0, configurations.reason);

    // Room counts until there is as much again as is needed.
    const double room = std::min(1.0, c.free / std::max(1e-9, 2 * c.needed));
    // Closing along the table the pads slide the part to their middle; across it the table holds it off.
    const double centring = 1 - std::abs(c.base_from_grasp.rotation.col(1).z());
    for (size_t k = 0; k < configurations.configurations.size() && int(k) < options_.configurations; ++k) {
      const GraspConfiguration& p = configurations.configurations[k];
      c.branch = p.configuration;
      c.pregrasp_joints = p.pregrasp;
      c.grasp_joints = p.grasp;
      c.lift_joints = p.lift;
      c.quality = grasp.quality * (0.5 + 0.5 * std::cos(tilt)) * room * centring / (1 + 0.1 * p.travel);
      candidates_.push_back(c);
    }
  }

  GraspPlan finish() {
    GraspPlan plan;
    const auto better = [](const GraspCandidate& a, const GraspCandidate& b) {
      return a.quality > b.quality;
    };
    std::stable_sort(candidates_.begin(), candidates_.end(), better);
    plan.candidates = variedFirst(candidates_, options_.max_candidates);
    std::stable_sort(plan.candidates.begin(), plan.candidates.end(), better);

    int all = 0;
    for (int k = 0; k < kRules; ++k) {
      if (counts_[size_t(k)] == 0) continue;
      plan.refusals.push_back({GraspRefusal(k), counts_[size_t(k)], examples_[size_t(k)]});
      all += counts_[size_t(k)];
    }

    if (!plan.candidates.empty()) return plan;
    plan.reason = fmt::format("{}: of {} grasps", object_.model->name, all);
    for (const RefusalCount& r : plan.refusals)
      plan.reason += fmt::format("{}{} {} ({})", &r == &plan.refusals.front() ? " " : "; ", r.count,
                                 toString(r.refusal), r.example);
    return plan;
  }

 private:
  void refuse(GraspRefusal rule, double miss, const std::string& example) {
    ++counts_[size_t(rule)];
    if (miss < miss_[size_t(rule)]) {
      miss_[size_t(rule)] = miss;
      examples_[size_t(rule)] = example;
    }
  }

  bool aboveTable(const GraspCandidate& c) {
    if (!scene_.table) return true;
    double lowest = std::numeric_limits<double>::max();
    const Eigen::Vector3d up = c.base_from_grasp.rotation.row(2);  // base z in the hand
    for (const Eigen::AlignedBox3d& box : handBoxes(gripper_, c.opening))
      lowest = std::min(lowest, up.dot(box.center()) - up.cwiseAbs().dot(box.sizes()) / 2);
    const double gap = lowest + c.base_from_grasp.translation.z() - scene_.table_height;
    if (gap >= options_.table_clearance) return true;
    refuse(GraspRefusal::kTable, options_.table_clearance - gap,
           "the hand comes to " + rounded(1e3 * gap) + " mm above the table, less than " +
               rounded(1e3 * options_.table_clearance) + " mm");
    return false;
  }

  bool clear(const GraspCandidate& c, const ClearanceNeed& need, const Rigid3& object_from_tcp) {
    const Boxes swept = sweptBoxes(gripper_, c.opening, c.part_width, options_.approach_distance);
    const Boxes shifted = grown(swept, {need.across, 0, need.along});
    const MeshInHand part(*object_.model, object_from_tcp.inverse());
    if (part.meets(shifted)) {
      if (part.meets(swept)) {
        refuse(GraspRefusal::kPart, 0,
               "the hand meets it with an opening of " + rounded(1e3 * c.opening) + " mm");
      } else {
        refuse(
            GraspRefusal::kClearance, need.across + need.along,
            fmt::format("{:g} sigma of the pose, {} mm across and {} mm along the approach, bring the hand "
                        "to the part",
                        options_.sigmas, rounded(1e3 * need.across), rounded(1e3 * need.along)));
      }
      return false;
    }

    const Boxes wide = grown(swept, Eigen::Vector3d::Constant(options_.obstacle_clearance));
    const Rigid3 tcp_from_base = c.base_from_grasp.inverse();
    for (const GraspObstacle& obstacle : scene_.obstacles) {
      if (!MeshInHand(*obstacle.model, tcp_from_base * obstacle.base_from_object).meets(wide)) continue;
      refuse(GraspRefusal::kObstacle, 0,
             fmt::format("the hand comes nearer than {} mm to {}",
                         int(std::lround(1e3 * options_.obstacle_clearance)), obstacle.model->name));
      return false;
    }
    return true;
  }

  const GraspObject& object_;
  const GraspScene& scene_;
  const GripperOptions& gripper_;
  const Puma560& arm_;
  const Rigid3 tcp_from_tool0_;
  const JointVector current_;
  const GraspPlanOptions& options_;
  const Matrix6d held_;
  std::vector<GraspCandidate> candidates_;
  std::array<int, kRules> counts_{};
  std::array<double, kRules> miss_;
  std::array<std::string, kRules> examples_;
};

void requireRigid(const Rigid3& pose, const char* what) {
  const Eigen::Matrix3d off = pose.rotation * pose.rotation.transpose() - Eigen::Matrix3d::Identity();
  if (!pose.isFinite() || off.cwiseAbs().maxCoeff() > 1e-6 || pose.rotation.determinant() < 0)
    throw BadInput(std::string(what) + " is no rigid transform");
}

}  // namespace

std::vector<GraspCandidate> variedFirst(const std::vector<GraspCandidate>& candidates, int count) {
  constexpr double kApart = 0.015, kTurned = 0.3;
  std::vector<GraspCandidate> taken;
  std::vector<char> used(candidates.size(), 0);
  for (size_t k = 0; k < candidates.size() && int(taken.size()) < count; ++k) {
    const GraspCandidate& c = candidates[k];
    const bool near = std::any_of(taken.begin(), taken.end(), [&](const GraspCandidate& other) {
      return c.branch.shoulder == other.branch.shoulder && c.branch.elbow == other.branch.elbow &&
             c.branch.wrist == other.branch.wrist &&
             (c.base_from_grasp.translation - other.base_from_grasp.translation).norm() <= kApart &&
             angleBetween(c.base_from_grasp.rotation, other.base_from_grasp.rotation) <= kTurned;
    });
    if (near) continue;
    used[k] = 1;
    taken.push_back(c);
  }

  for (size_t k = 0; k < candidates.size() && int(taken.size()) < count; ++k)
    if (!used[k]) taken.push_back(candidates[k]);
  return taken;
}

GraspPlan planGrasps(const GraspObject& object, const ModelGrasps& grasps, const GraspScene& scene,
                     const GripperOptions& gripper, const Puma560& arm, const Rigid3& tool0_from_tcp,
                     const JointVector& current, const GraspPlanOptions& options) {
  gripper.check();
  options.check();
  if (!object.model) throw BadInput("planGrasps: the object has no model");
  requireRigid(object.base_from_object, "base_from_object");
  requireRigid(tool0_from_tcp, "tool0_from_tcp");
  requireCovariance(object.covariance, "covariance of the object");
  if (!current.allFinite()) throw BadInput("the current joint angles are not finite");
  for (const GraspObstacle& obstacle : scene.obstacles) {
    if (!obstacle.model) throw BadInput("planGrasps: an obstacle has no model");
    requireRigid(obstacle.base_from_object, "base_from_object of an obstacle");
  }

  if (grasps.grasps.empty()) {
    GraspPlan none;
    none.reason = grasps.reason.empty() ? object.model->name + ": no grasps are known" : grasps.reason;
    return none;
  }

  const auto planned = [&](const GraspObject& placed) {
    Planner planner(placed, scene, gripper, arm, tool0_from_tcp, current, options);
    planner.tryAll(grasps);
    return planner.finish();
  };
  GraspPlan plan = planned(object);

  const auto uncertain = [](const RefusalCount& r) { return r.refusal == GraspRefusal::kClearance; };
  if (plan.candidates.empty() && std::any_of(plan.refusals.begin(), plan.refusals.end(), uncertain)) {
    GraspObject certain = object;
    certain.covariance.setZero();
    plan.too_uncertain = !planned(certain).candidates.empty();
  }
  return plan;
}

}  // namespace monocular_eye_hand
