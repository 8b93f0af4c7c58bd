#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "nodes/planner_work.h"

namespace monocular_eye_hand {
namespace {

constexpr double kThere = 1e-3;  // joints so near to the goal need no motion [rad]

std::vector<JointVector> jointsOf(const MoveGoal& goal) {
  if (goal.joints.empty()) return {};
  if (goal.joints.size() != 6)
    throw BadInput("joints holds " + std::to_string(goal.joints.size()) + " angles: give six, or none");
  const JointVector joints = Eigen::Map<const JointVector>(goal.joints.data());
  if (!joints.allFinite()) throw BadInput("joints is not finite");
  return {joints};
}

}  // namespace

ActionResult PlannerWork::move(const MoveGoal& goal, const WorkWatch& watch) {
  driver_.resetMotionTime();
  MoveRequest request;
  try {
    request.joints = jointsOf(goal);
    if (request.joints.empty()) request.base_from_tcp = tcpPosesOf(goal, description_);
  } catch (const BadInput& e) {
    return refuse(e.what());
  }

  recall();
  watch.say("plan", 0);
  const ros::WallTime begin = ros::WallTime::now();
  request.start = start();
  const GripperState gripper = driver_.gripper();
  if (held_ && !lost(gripper).empty()) held_.reset();

  const bool drops = held_ && goal.open_gripper;
  CollisionWorld world = scene_.world(held_ ? std::optional<PlacedObject>(held_->object) : std::nullopt, -1,
                                      inHand(request.start));
  double opening = gripper.width;
  if (held_ && !drops) {
    world.attach(held_->object.label(), held_->tcp_from_object);
    request.touching.emplace_back(held_->object.label(), "table");
  } else if (goal.open_gripper) {
    if (drops) world.remove(held_->object.label());  // it will lie nobody knows where
    opening =
        freeOpening(world, request.start, visit_.object ? visit_.opening : description_.gripper_width_max);
  }
  world.setGripperWidth(opening);
  for (const auto& pair : touching(world)) request.touching.push_back(pair);

  MovePlan plan;
  const bool there =
      !request.joints.empty() && (request.joints[0] - request.start).cwiseAbs().maxCoeff() <= kThere;
  if (there) {
    plan.outcome = MoveOutcome::kPlanned;
    plan.goal = 0;
  } else {
    plan = planMove(arm_, world, request, parameters_.planning);
  }
  const double planning_time = (ros::WallTime::now() - begin).toSec();
  watch.say("plan", 1);

  ActionResult ended = plan.planned()
                           ? driveMove(plan, goal.open_gripper ? opening : -1, watch)
                           : result(outcomeOf(plan.outcome), name(plan.outcome) + ": " + plan.reason);
  if (plan.outcome == MoveOutcome::kStartInCollision) ended.reason += "; " + recoverHint();
  ended.planning_time = planning_time;
  if (ended.done()) ended.reached = plan.goal;
  return ended;
}

ActionResult PlannerWork::driveMove(const MovePlan& plan, double opening, const WorkWatch& watch) {
  watch.show(plan.motions);
  if (watch.cancelled()) return result(ActionOutcome::kCancelled, "cancelled before anything moved");
  Drive drive;
  if (opening >= 0) {
    held_.reset();
    keepMemory(std::nullopt);
    drive = driver_.openGripper(opening, driveWatch(watch, "open", false));
  }
  for (const Trajectory& motion : plan.motions) {
    if (!drive.done()) break;
    drive = driver_.follow(motion, driveWatch(watch, "move", held_.has_value()));
    if (drive.done()) visit_ = {};
  }
  if (drive.outcome == ActionOutcome::kGraspLost) held_.reset();
  if (held_) held_->kept.reset();
  return result(drive);
}

}  // namespace monocular_eye_hand
