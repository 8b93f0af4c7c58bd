#include "execution/stopwatch.h"
#include "monocular_eye_hand/execution/executor.h"

namespace monocular_eye_hand {
namespace {

constexpr double kThere = 1e-3;  // joints within this of the goal need no motion [rad]

bool isThere(const MoveRequest& request) {
  return !request.joints.empty() && (request.joints[0] - request.start).cwiseAbs().maxCoeff() <= kThere;
}

MovePlan nothingToMove() {
  MovePlan plan;
  plan.outcome = MoveOutcome::kPlanned;
  plan.goal = 0;
  return plan;
}

}  // namespace

ActionResult PickPlaceExecutor::move(const MoveOrder& order, const ActionMonitor& monitor) {
  motion_.resetMotionTime();
  recall(monitor);

  monitor.reportProgress("plan", 0);
  const Stopwatch planning;
  const PlannedMove planned = planTheMove(order);
  const double planning_time = planning.seconds();
  monitor.reportProgress("plan", 1);

  const MovePlan& plan = planned.plan;
  ActionResult ended = plan.planned()
                           ? driveMove(plan, order.open_gripper ? planned.opening : -1, monitor)
                           : result(outcomeOf(plan.outcome), toString(plan.outcome) + ": " + plan.reason);
  if (plan.outcome == MoveOutcome::kStartInCollision) ended.reason += "; " + texts_.recover_hint;
  ended.planning_time = planning_time;
  if (ended.done()) ended.reached = plan.goal;
  return ended;
}

PickPlaceExecutor::PlannedMove PickPlaceExecutor::planTheMove(const MoveOrder& order) {
  MoveRequest request;
  request.base_from_tcp = order.base_from_tcp;
  request.joints = order.joints;
  request.start = start();
  const GripperReading gripper = motion_.gripper();
  if (held_ && !lost(gripper).empty()) held_.reset();

  PlannedMove planned;
  planned.opening = gripper.width;
  const bool drops = held_ && order.open_gripper;
  CollisionWorld world = scene_.world(heldObject(), -1, inHand(request.start));
  if (held_ && !drops) {
    world.attach(held_->object.label(), held_->tcp_from_object);
    request.touching.emplace_back(held_->object.label(), "table");
  } else if (order.open_gripper) {
    if (drops) world.remove(held_->object.label());  // it will lie nobody knows where
    const double wanted = visit_.object ? visit_.opening : description_.gripper_width_max;
    planned.opening = freeOpening(world, request.start, wanted);
  }
  world.setGripperWidth(planned.opening);
  for (const auto& pair : touching(world)) request.touching.push_back(pair);

  planned.plan = isThere(request) ? nothingToMove() : planMove(arm_, world, request, options_.planning);
  return planned;
}

/// `opening`: of the gripper before the arm moves [m]; negative: as it is.
ActionResult PickPlaceExecutor::driveMove(const MovePlan& plan, double opening,
                                          const ActionMonitor& monitor) {
  monitor.show(plan.motions);
  if (monitor.cancelled()) return result(ActionOutcome::kCancelled, "cancelled before anything moved");
  MotionResult moved;
  if (opening >= 0) {
    letGo();
    moved = motion_.openGripper(opening, motionMonitor(monitor, "open", false));
  }

  for (const Trajectory& motion : plan.motions) {
    if (!moved.done()) break;
    moved = motion_.follow(motion, motionMonitor(monitor, "move", held_.has_value()));
    if (moved.done()) visit_ = {};
  }

  if (moved.outcome == ActionOutcome::kGraspLost) held_.reset();
  if (held_) held_->kept.reset();
  return result(moved);
}

}  // namespace monocular_eye_hand
