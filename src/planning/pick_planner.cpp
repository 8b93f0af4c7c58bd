#include "monocular_eye_hand/planning/pick_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "planning/limits.h"
#include "planning/pick_ways.h"

namespace monocular_eye_hand {
namespace {

void requireRequest(const CollisionWorld& world, const ToolArm& arm, const PickRequest& request) {
  const PickTarget& target = request.target;
  if (!world.has(target.object)) throw BadInput("the object \"" + target.object + "\" is not in the world");
  if (!world.carried().empty()) throw BadInput("the gripper holds " + world.carried() + " already");
  for (const std::string& support : request.supports)
    if (!world.has(support)) throw BadInput("the support \"" + support + "\" is not in the world");
  if (!request.start.allFinite()) throw BadInput("the start joints are not finite");
  if (!arm.arm.withinLimits(request.start)) throw BadInput("the start joints are outside their limits");
  if (request.drops.empty()) throw BadInput("there is no drop pose");
  bool finite = target.base_from_pregrasp.isFinite() && target.base_from_grasp.isFinite() &&
                target.base_from_lift.isFinite();
  for (const DropTarget& drop : request.drops)
    finite &= drop.base_from_tcp.isFinite() && drop.base_from_tcp_above.isFinite();
  if (!finite) throw BadInput("a pose of gripper_tcp is not finite");
  for (double width : {target.opening, target.part_width})
    if (!(width >= 0 && width <= 1)) throw BadInput("the gripper's width must be 0 to 1 m");
}

class Planner {
 public:
  Planner(const ToolArm& arm, const CollisionWorld& world, const PickRequest& request,
          const PlanningOptions& options, double padding)
      : arm_(arm),
        request_(request),
        options_(options),
        worlds_(world, request, padding, options.near_padding) {
    near_timing_ = options.timing;
    near_timing_.tool_speed = std::min(options.near_speed, options.timing.tool_speed);
    near_timing_.corner = std::min(kNearCorner, options.timing.corner);
    for (const DropTarget& drop : request.drops)
      released_.push_back(worlds_.released(request, drop, options.near_padding));
  }

  PickPlan run() {
    const PickTarget& target = request_.target;
    const auto solutions =
        solutionsByTime(arm_, target.base_from_pregrasp, request_.start, options_.candidates);
    if (solutions.empty())
      failure_.record(PickOutcome::kGraspUnreachable, "pre-grasp: out of reach or joint limits");
    for (const JointVector& before : solutions) {
      GraspWay way;
      if (!graspWay(arm_, worlds_, target, before, options_, &way, &failure_)) continue;
      JointPath reach =
          search(worlds_.reach, request_.start, before, PickOutcome::kNoPathToGrasp, "the pre-grasp");
      if (!reach.found()) continue;
      if (finish(reach, way)) return plan_;
    }
    plan_ = PickPlan();
    plan_.outcome = failure_.outcome;
    plan_.reason = failure_.reason;
    return plan_;
  }

 private:
  JointPath search(const CollisionWorld& world, const JointVector& from, const JointVector& to,
                   PickOutcome none, const char* what) {
    JointPath path;
    if (failed_searches_ >= kFailedSearches) return path;
    PathOptions options = options_.path;
    options.budget = std::max(1, options.budget / kFailedSearches);
    path = planPath(arm_.arm.options().joints, from, {to}, testIn(world), options);
    if (path.found()) return path;
    ++failed_searches_;
    failure_.record(none, fmt::format("no free path to {} found in {} tests (budget {})", what, path.tests,
                                      options.budget));
    return path;
  }

  /// From the end of the lift to a drop.
  bool finish(const JointPath& reach, const GraspWay& way) {
    const JointVector& lifted = way.lift.back();
    for (size_t k = 0; k < request_.drops.size(); ++k) {
      const DropTarget& drop = request_.drops[k];
      const auto solutions = solutionsByTime(arm_, drop.base_from_tcp_above, lifted, options_.candidates);
      if (solutions.empty())
        failure_.record(PickOutcome::kDropUnreachable, "above the drop: out of reach or joint limits");

      for (const JointVector& above : solutions) {
        DropWay put;
        if (!dropWay(arm_, worlds_, released_[k], drop, above, options_, &put, &failure_)) continue;
        const JointPath carry = search(worlds_.carry, lifted, above, PickOutcome::kNoPathToDrop, "the drop");
        if (!carry.found()) continue;

        plan_.drop = int(k);
        plan_.configuration = arm_.arm.configuration(way.approach.back());
        compose(reach, way, carry, put);
        return true;
      }
    }
    return false;
  }

  void add(PickStage stage, const std::vector<JointVector>& path, const CollisionWorld& world, double width,
           const TimingOptions& timing) {
    plan_.motions.push_back({stage, timeParameterise(arm_, path, testIn(world), timing), width});
  }

  void compose(const JointPath& reach, const GraspWay& way, const JointPath& carry, const DropWay& put) {
    const double open = request_.target.opening, grip = request_.target.part_width;
    const CollisionWorld& released = released_[plan_.drop];
    add(PickStage::kReach, reach.points, worlds_.reach, open, options_.timing);
    add(PickStage::kApproach, way.approach, worlds_.approach, open, near_timing_);
    add(PickStage::kLift, way.lift, worlds_.lift, grip, near_timing_);
    add(PickStage::kCarry, carry.points, worlds_.carry, grip, options_.timing);
    add(PickStage::kLower, put.lower, worlds_.lift, grip, near_timing_);
    add(PickStage::kRetreat, put.retreat, released, open, near_timing_);
  }

  const ToolArm& arm_;
  const PickRequest& request_;
  const PlanningOptions& options_;
  TimingOptions near_timing_;
  PickWorlds worlds_;
  std::vector<CollisionWorld> released_;
  PickFailure failure_;
  PickPlan plan_;
  int failed_searches_ = 0;
};

}  // namespace

std::string toString(PickOutcome outcome) {
  switch (outcome) {
    case PickOutcome::kPlanned:
      return "planned";
    case PickOutcome::kStartInCollision:
      return "start in collision";
    case PickOutcome::kGraspUnreachable:
      return "grasp unreachable";
    case PickOutcome::kGraspInCollision:
      return "grasp in collision";
    case PickOutcome::kApproachBlocked:
      return "approach blocked";
    case PickOutcome::kLiftBlocked:
      return "lift blocked";
    case PickOutcome::kNoPathToGrasp:
      return "no path to the grasp";
    case PickOutcome::kDropUnreachable:
      return "drop unreachable";
    case PickOutcome::kDropInCollision:
      return "drop in collision";
    case PickOutcome::kLoweringBlocked:
      return "lowering blocked";
    case PickOutcome::kNoPathToDrop:
      return "no path to the drop";
  }

  return "unknown";
}

ActionOutcome outcomeOf(PickOutcome outcome) {
  switch (outcome) {
    case PickOutcome::kPlanned:
      return ActionOutcome::kDone;
    case PickOutcome::kStartInCollision:
    case PickOutcome::kGraspInCollision:
    case PickOutcome::kApproachBlocked:
    case PickOutcome::kLiftBlocked:
    case PickOutcome::kDropInCollision:
    case PickOutcome::kLoweringBlocked:
      return ActionOutcome::kInCollision;
    case PickOutcome::kGraspUnreachable:
    case PickOutcome::kNoPathToGrasp:
    case PickOutcome::kDropUnreachable:
    case PickOutcome::kNoPathToDrop:
      break;
  }
  return ActionOutcome::kUnreachable;
}

std::string toString(PickStage stage) {
  switch (stage) {
    case PickStage::kReach:
      return "reach";
    case PickStage::kApproach:
      return "approach";
    case PickStage::kLift:
      return "lift";
    case PickStage::kCarry:
      return "carry";
    case PickStage::kLower:
      return "lower";
    case PickStage::kRetreat:
      return "retreat";
  }
  return "unknown";
}

const PickMotion& PickPlan::motion(PickStage stage) const {
  for (const PickMotion& motion : motions)
    if (motion.stage == stage) return motion;
  throw BadInput("the plan has no motion \"" + toString(stage) + "\"");
}

std::vector<Trajectory> PickPlan::trajectories() const {
  std::vector<Trajectory> all;
  for (const PickMotion& motion : motions) all.push_back(motion.trajectory);
  return all;
}

double PickPlan::duration() const {
  double sum = 0;
  for (const PickMotion& motion : motions) sum += motion.trajectory.duration();
  return sum;
}

PickPlan planPick(const ToolArm& arm, const CollisionWorld& world, const PickRequest& request,
                  const PlanningOptions& options) {
  options.check();
  requireRequest(world, arm, request);
  // An arm that stands nearer to something than the padding must be able to leave.
  CollisionWorld start = world;
  start.setGripperWidth(request.target.opening);
  double padding = options.padding;
  for (start.setPadding(padding); !start.valid(request.start); start.setPadding(padding)) {
    if (padding <= options.near_padding) {
      PickPlan plan;
      plan.outcome = PickOutcome::kStartInCollision;
      plan.reason = "start: " + describe(start.firstCollision(request.start));
      return plan;
    }
    padding = std::max(options.near_padding, padding / 2);
  }
  return Planner(arm, world, request, options, padding).run();
}

CollisionWorld worldOf(PickStage stage, const CollisionWorld& world, const PickRequest& request,
                       const PickPlan& plan) {
  if (!plan.planned()) throw BadInput("a pick that is not planned has no motions");
  const PickWorlds worlds(world, request, 0, 0);
  switch (stage) {
    case PickStage::kReach:
      return worlds.reach;
    case PickStage::kApproach:
      return worlds.approach;
    case PickStage::kLift:
    case PickStage::kLower:
      return worlds.lift;
    case PickStage::kCarry:
      return worlds.carry;
    case PickStage::kRetreat:
      break;
  }
  return worlds.released(request, request.drops.at(plan.drop), 0);
}

}  // namespace monocular_eye_hand
