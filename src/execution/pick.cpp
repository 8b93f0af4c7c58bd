#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "execution/drop_zone.h"
#include "execution/stopwatch.h"
#include "monocular_eye_hand/execution/executor.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/planning/pick_planner.h"

namespace monocular_eye_hand {
namespace {

std::vector<Trajectory> trajectoriesOf(const Departure& departure, const PickPlan& plan) {
  std::vector<Trajectory> all = plan.trajectories();
  if (!departure.trajectory.points.empty()) all.insert(all.begin(), departure.trajectory);
  return all;
}

std::string otherWidth(const GripperReading& gripper, const PlacedObject& object, double part_width) {
  return fmt::format("the gripper closed to {:.3g} mm{} and {} is {:.3g} mm wide there", gripper.width * 1e3,
                     gripper.stalled ? " (stalled)" : "", object.label(), part_width * 1e3);
}

}  // namespace

ActionResult PickPlaceExecutor::pick(const PickOrder& order, const ActionMonitor& monitor) {
  motion_.resetMotionTime();
  try {
    scene_.requireKnown(order.object.name);
  } catch (const BadInput& e) {
    return refuseBadGoal(e.what());
  }
  if (!hasPlace(order.place)) return noPlace(order.place);
  if (!seen_)
    return result(ActionOutcome::kFault,
                  "nothing came on " + texts_.objects_source + " yet: what stands around is not known");

  recall(monitor);
  const GripperReading gripper = motion_.gripper();
  if (held_ && lost(gripper).empty())
    return result(ActionOutcome::kFault,
                  "the gripper holds " + held_->object.label() + ": place it first; " + texts_.recover_hint);
  held_.reset();

  monitor.reportProgress("plan", 0);
  const Stopwatch planning;
  PickTarget target = order.target;
  target.object = order.object.label();
  const PlannedPick planned = planThePick(order.object, target, order.place);
  const double planning_time = planning.seconds();
  monitor.reportProgress("plan", 1);

  ActionResult ended = drivePick(order.object, planned, monitor);
  ended.planning_time = planning_time;
  return ended;
}

PickPlaceExecutor::PlannedPick PickPlaceExecutor::planThePick(const PlacedObject& object,
                                                              const PickTarget& target, int place) {
  PlannedPick planned;
  const JointVector joints = start();
  CollisionWorld world = scene_.world(object, place);
  planned.refused = sweep(world, joints, motion_.gripper().width, target.opening);
  if (!planned.refused.empty()) {
    planned.refused = "opening the gripper where it stands: " + planned.refused + "; " + texts_.recover_hint;
    return planned;
  }

  world.setGripperWidth(target.opening);
  planned.departure = planDeparture(arm_, world, joints, touching(world), options_.planning);
  if (!planned.departure.possible) {
    planned.refused = planned.departure.reason + "; " + texts_.recover_hint;
    return planned;
  }

  planned.kept.place = place;
  planned.kept.request = pickRequest(object, target, place, planned.departure.end);
  planned.kept.plan = planPick(arm_, world, planned.kept.request, options_.planning);
  // Perhaps the arm was stopped in a narrow place.
  if (planned.kept.plan.outcome == PickOutcome::kNoPathToGrasp) planAfterWithdrawal(world, joints, &planned);
  return planned;
}

PickRequest PickPlaceExecutor::pickRequest(const PlacedObject& object, const PickTarget& target, int place,
                                           const JointVector& start) const {
  PickRequest request;
  request.start = start;
  request.target = target;
  request.drops =
      dropTargets(places_[size_t(place)], footprintOf(scene_.mesh(object.name), object.base_from_object),
                  target.base_from_grasp, options_.drop_gap, options_.drop_above);
  request.supports = {"table"};
  return request;
}

/// With the first withdrawal that leads to a plan instead of the departure; as it was when none does.
void PickPlaceExecutor::planAfterWithdrawal(const CollisionWorld& world, const JointVector& joints,
                                            PlannedPick* planned) const {
  for (const Departure& withdrawal :
       planWithdrawals(arm_, world, joints, touching(world), options_.planning)) {
    PickRequest request = planned->kept.request;
    request.start = withdrawal.end;
    const PickPlan plan = planPick(arm_, world, request, options_.planning);
    if (!plan.planned()) continue;

    planned->departure = withdrawal;
    planned->kept.request = request;
    planned->kept.plan = plan;
    return;
  }
}

ActionResult PickPlaceExecutor::drivePick(const PlacedObject& object, const PlannedPick& planned,
                                          const ActionMonitor& monitor) {
  const PickPlan& plan = planned.kept.plan;
  if (!planned.refused.empty()) return result(ActionOutcome::kInCollision, planned.refused);
  if (!plan.planned()) return result(outcomeOf(plan.outcome), toString(plan.outcome) + ": " + plan.reason);

  monitor.show(trajectoriesOf(planned.departure, plan));
  if (monitor.cancelled()) return result(ActionOutcome::kCancelled, "cancelled before anything moved");
  MotionResult moved = driveToPregrasp(planned, monitor);
  if (moved.done()) moved = grasp(object, planned.kept, monitor);
  return result(moved);
}

MotionResult PickPlaceExecutor::driveToPregrasp(const PlannedPick& planned, const ActionMonitor& monitor) {
  const MotionMonitor reach = motionMonitor(monitor, "reach", false);
  MotionResult moved = motion_.openGripper(planned.kept.request.target.opening, reach);
  if (moved.done()) moved = motion_.follow(planned.departure.trajectory, reach);
  if (!moved.done()) return moved;

  visit_ = {};
  return motion_.follow(planned.kept.plan.motion(PickStage::kReach).trajectory, reach);
}

MotionResult PickPlaceExecutor::grasp(const PlacedObject& object, const KeptPlan& kept,
                                      const ActionMonitor& monitor) {
  visit_ = {object, kept.request.target.opening};
  MotionResult moved = motion_.follow(kept.plan.motion(PickStage::kApproach).trajectory,
                                      motionMonitor(monitor, "approach", false));
  if (moved.done()) moved = closeOn(object, kept, motionMonitor(monitor, "close", false));
  if (moved.done())
    moved =
        motion_.follow(kept.plan.motion(PickStage::kLift).trajectory, motionMonitor(monitor, "lift", true));

  if (moved.outcome == ActionOutcome::kGraspLost) letGo();
  if (held_ && !moved.done()) held_->kept.reset();
  if (moved.done()) visit_ = {};
  return moved;
}

MotionResult PickPlaceExecutor::closeOn(const PlacedObject& object, const KeptPlan& kept,
                                        const MotionMonitor& monitor) {
  const PickTarget& target = kept.request.target;
  memory_.keep(PickMemory{object, target, motion_.clock()});  // before: a crash may come at any time
  const double squeezed = std::max(0.0, target.part_width - options_.execution.squeeze);
  MotionResult moved = motion_.closeGripper(squeezed, monitor);
  if (moved.outcome == ActionOutcome::kFault) return moved;

  const GripperReading gripper = motion_.gripper();
  const double off = std::abs(gripper.width - target.part_width);
  if (!gripper.stalled || off > options_.execution.width_tolerance)
    return {ActionOutcome::kGraspLost, otherWidth(gripper, object, target.part_width)};

  held_ = holdPart(object, target, gripper.width);
  held_->kept = kept;
  scene_.takeAway(object);
  return moved;
}

}  // namespace monocular_eye_hand
