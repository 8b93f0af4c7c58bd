#include <algorithm>

#include "execution/drop_zone.h"
#include "execution/stopwatch.h"
#include "monocular_eye_hand/execution/executor.h"
#include "monocular_eye_hand/planning/pick_planner.h"

namespace monocular_eye_hand {
namespace {

constexpr double kRecheck = 0.005;  // step of a kept plan that is tested again [rad]

/// What is left of a planned pick when the object is lifted.
PickPlan afterLift(PickPlan plan) {
  const auto carries = [](const PickMotion& motion) { return motion.stage == PickStage::kCarry; };
  plan.motions.erase(plan.motions.begin(), std::find_if(plan.motions.begin(), plan.motions.end(), carries));
  return plan;
}

}  // namespace

ActionResult PickPlaceExecutor::place(const PlaceOrder& order, const ActionMonitor& monitor) {
  motion_.resetMotionTime();
  if (!hasPlace(order.place)) return noPlace(order.place);

  recall(monitor);
  if (!held_) {
    const bool unknown = holdsSomething(motion_.gripper());
    return result(ActionOutcome::kGraspLost,
                  "the gripper holds nothing that was picked" +
                      (unknown ? ", and is not empty: " + texts_.recover_hint : std::string()));
  }
  if (const std::string gone = lost(motion_.gripper()); !gone.empty()) {
    held_.reset();
    return result(ActionOutcome::kGraspLost, gone);
  }

  monitor.reportProgress("plan", 0);
  const Stopwatch planning;
  const JointVector joints = start();
  const bool fits = keptFits(order.place, joints);
  const PickPlan plan = fits ? afterLift(held_->kept->plan) : planThePlace(order.place, joints);
  held_->kept.reset();
  const double planning_time = planning.seconds();
  monitor.reportProgress("plan", 1);

  ActionResult ended = drivePlace(order.place, plan, monitor);
  if (plan.outcome == PickOutcome::kStartInCollision) ended.reason += "; " + texts_.recover_hint;
  ended.planning_time = planning_time;
  return ended;
}

/// Whether pick() kept a plan for this place that begins where the arm is and is free in the world of now.
bool PickPlaceExecutor::keptFits(int place, const JointVector& joints) const {
  if (!held_->kept || held_->kept->place != place) return false;
  const KeptPlan& kept = *held_->kept;
  const JointVector begin = kept.plan.motion(PickStage::kCarry).trajectory.points.front().position;
  if ((joints - begin).cwiseAbs().maxCoeff() > options_.execution.start_tolerance) return false;

  const CollisionWorld now = scene_.world(held_->object, place, inHand(joints));
  for (const PickStage stage : {PickStage::kCarry, PickStage::kLower, PickStage::kRetreat}) {
    const CollisionWorld world = worldOf(stage, now, kept.request, kept.plan);
    if (!firstCollision(world, kept.plan.motion(stage).trajectory, kRecheck).first.empty()) return false;
  }
  return true;
}

/// `free`: the caller says that nothing stands at the place; else it must be known to be free.
PickPlan PickPlaceExecutor::planThePlace(int place, const JointVector& joints, bool free) const {
  PlaceRequest request;
  request.start = joints;
  request.object = held_->object.label();
  request.tcp_from_object = held_->tcp_from_object;
  request.opening = held_->target.opening;
  request.part_width = held_->target.part_width;
  request.supports = {"table"};
  request.drops = dropTargets(places_[size_t(place)],
                              footprintOf(scene_.mesh(held_->object.name), held_->object.base_from_object),
                              held_->target.base_from_grasp, options_.drop_gap, options_.drop_above);

  const CollisionWorld world = scene_.world(held_->object, free ? place : -1, inHand(joints));
  return planPlace(arm_, world, request, options_.planning);
}

ActionResult PickPlaceExecutor::drivePlace(int place, const PickPlan& plan, const ActionMonitor& monitor) {
  if (!plan.planned()) return result(outcomeOf(plan.outcome), toString(plan.outcome) + ": " + plan.reason);
  monitor.show(plan.trajectories());
  if (monitor.cancelled()) return result(ActionOutcome::kCancelled, "cancelled before anything moved");
  MotionResult moved = carry(plan, monitor);
  if (!moved.done()) return result(moved);

  const PlacedObject object = putDownBy(plan);
  const double opening = held_->target.opening;
  visit_ = {object, opening};
  moved = motion_.openGripper(opening, motionMonitor(monitor, "open", false));
  if (moved.outcome == ActionOutcome::kFault) return result(moved);

  letGo();
  scene_.putDown(place, object);
  if (moved.done())
    moved =
        motion_.follow(plan.motion(PickStage::kRetreat).trajectory, motionMonitor(monitor, "retreat", false));
  if (moved.done()) visit_ = {};
  return result(moved);
}

/// All motions before the gripper opens.
MotionResult PickPlaceExecutor::carry(const PickPlan& plan, const ActionMonitor& monitor) {
  for (const PickMotion& motion : plan.motions) {
    if (motion.stage == PickStage::kRetreat) continue;
    const char* stage = motion.stage == PickStage::kLower ? "lower" : "carry";
    const MotionResult moved = motion_.follow(motion.trajectory, motionMonitor(monitor, stage, true));
    if (moved.outcome == ActionOutcome::kGraspLost) held_.reset();
    if (!moved.done()) return moved;
  }
  return {};
}

/// What is held, as it stands when it was let go at the end of kLower.
PlacedObject PickPlaceExecutor::putDownBy(const PickPlan& plan) const {
  const JointVector lowered = plan.motion(PickStage::kLower).trajectory.points.back().position;
  PlacedObject object = held_->inHand(arm_.baseFromTcp(lowered));
  object.base_from_object.translation.z() -= options_.drop_gap;
  return object;
}

}  // namespace monocular_eye_hand
