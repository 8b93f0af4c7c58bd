#include <algorithm>
#include <sstream>

#include "monocular_eye_hand/geometry/error.h"
#include "nodes/conversion.h"
#include "nodes/planner_work.h"

namespace monocular_eye_hand {
namespace {

double secondsSince(const ros::WallTime& begin) { return (ros::WallTime::now() - begin).toSec(); }

std::vector<Trajectory> trajectoriesOf(const std::vector<PickMotion>& motions) {
  std::vector<Trajectory> trajectories;
  for (const PickMotion& motion : motions) trajectories.push_back(motion.trajectory);
  return trajectories;
}

/// What is left of a planned pick when the object is lifted.
PickPlan afterLift(PickPlan plan) {
  const auto carries = [](const PickMotion& motion) { return motion.stage == PickStage::kCarry; };
  plan.motions.erase(plan.motions.begin(), std::find_if(plan.motions.begin(), plan.motions.end(), carries));
  return plan;
}

std::string noPlace(int place, size_t places) {
  return "there is no place " + std::to_string(place) + ": the drop zone has " + std::to_string(places) +
         ", counted from 0";
}

constexpr double kRecheck = 0.005;  // step of a kept plan that is tested again [rad]

}  // namespace

PlacedObject PlannerWork::checked(const PickGoal& goal, PickTarget* target) const {
  if (withoutSlash(goal.target.header.frame_id) != parameters_.base_frame)
    throw BadInput("target.header.frame_id is '" + goal.target.header.frame_id + "' and must be '" +
                   parameters_.base_frame + "', the arm's base");
  if (!scene_.knows(goal.target.name))
    throw BadInput("no object is named '" + goal.target.name + "'; known: " + scene_.names());
  PlacedObject object{goal.target.name, goal.target.instance,
                      poseOf(goal.target.object.pose, "target.object")};
  *target = pickTargetOf(goal.target, object.label(), description_.gripper_width_max);
  return object;
}

ActionResult PlannerWork::pick(const PickGoal& goal, const WorkWatch& watch) {
  driver_.resetMotionTime();
  if (!goal.target.feasible)
    return result(ActionOutcome::kUnreachable,
                  "the target says that it is not feasible: " + goal.target.reason);
  PlacedObject object;
  PickTarget target;
  try {
    object = checked(goal, &target);
  } catch (const BadInput& e) {
    return refuse(e.what());
  }
  if (goal.place < 0 || goal.place >= int(places_.size()))
    return result(ActionOutcome::kUnreachable, noPlace(goal.place, places_.size()));
  if (!seen_)
    return result(ActionOutcome::kFault,
                  "nothing came on eye_hand/objects yet: what stands around is not known");

  recall();
  const GripperState gripper = driver_.gripper();
  if (held_ && lost(gripper).empty())
    return result(ActionOutcome::kFault,
                  "the gripper holds " + held_->object.label() + ": place it first; " + recoverHint());
  held_.reset();

  watch.say("plan", 0);
  const ros::WallTime begin = ros::WallTime::now();
  const PlannedPick planned = planThePick(object, target, goal.place);
  const double planning_time = secondsSince(begin);
  watch.say("plan", 1);

  ActionResult ended;
  if (!planned.refused.empty())
    ended = result(ActionOutcome::kInCollision, planned.refused);
  else if (!planned.kept.plan.planned())
    ended = result(outcomeOf(planned.kept.plan.outcome),
                   name(planned.kept.plan.outcome) + ": " + planned.kept.plan.reason);
  else
    ended = drivePick(object, planned, watch);
  ended.planning_time = planning_time;
  return ended;
}

PlannerWork::PlannedPick PlannerWork::planThePick(const PlacedObject& object, const PickTarget& target,
                                                  int place) {
  PlannedPick planned;
  const JointVector joints = start();
  CollisionWorld world = scene_.world(object, place);
  planned.refused = sweep(world, joints, driver_.gripper().width, target.opening);
  if (!planned.refused.empty()) {
    planned.refused = "opening the gripper where it stands: " + planned.refused + "; " + recoverHint();
    return planned;
  }

  world.setGripperWidth(target.opening);
  planned.departure = planDeparture(arm_, world, joints, touching(world), parameters_.planning);
  if (!planned.departure.possible) {
    planned.refused = planned.departure.reason + "; " + recoverHint();
    return planned;
  }

  PickRequest& request = planned.kept.request;
  request.start = planned.departure.end;
  request.target = target;
  request.drops =
      dropTargets(places_[size_t(place)], footprintOf(scene_.mesh(object.name), object.base_from_object),
                  target.base_from_grasp, parameters_.drop_gap, parameters_.drop_above);
  request.supports = {"table"};
  planned.kept.place = place;
  planned.kept.plan = planPick(arm_, world, request, parameters_.planning);
  if (planned.kept.plan.outcome != PickOutcome::kNoPathToGrasp) return planned;

  // Perhaps the arm was stopped in a narrow place.
  for (const Departure& withdrawal :
       planWithdrawals(arm_, world, joints, touching(world), parameters_.planning)) {
    PickRequest later = request;
    later.start = withdrawal.end;
    const PickPlan plan = planPick(arm_, world, later, parameters_.planning);
    if (!plan.planned()) continue;
    planned.departure = withdrawal;
    planned.kept.request = later;
    planned.kept.plan = plan;
    return planned;
  }
  return planned;
}

ActionResult PlannerWork::drivePick(const PlacedObject& object, const PlannedPick& planned,
                                    const WorkWatch& watch) {
  const PickPlan& plan = planned.kept.plan;
  std::vector<Trajectory> shown = trajectoriesOf(plan.motions);
  if (!planned.departure.trajectory.points.empty()) shown.insert(shown.begin(), planned.departure.trajectory);
  watch.show(shown);
  if (watch.cancelled()) return result(ActionOutcome::kCancelled, "cancelled before anything moved");

  const DriveWatch reach = driveWatch(watch, "reach", false);
  Drive drive = driver_.openGripper(planned.kept.request.target.opening, reach);
  if (drive.done()) drive = driver_.follow(planned.departure.trajectory, reach);
  if (drive.done()) visit_ = {};
  if (drive.done()) drive = driver_.follow(plan.motion(PickStage::kReach).trajectory, reach);
  if (!drive.done()) return result(drive);

  visit_ = {object, planned.kept.request.target.opening};
  drive = driver_.follow(plan.motion(PickStage::kApproach).trajectory, driveWatch(watch, "approach", false));
  if (drive.done()) drive = closeOn(object, planned.kept, driveWatch(watch, "close", false));
  if (drive.done())
    drive = driver_.follow(plan.motion(PickStage::kLift).trajectory, driveWatch(watch, "lift", true));

  if (drive.outcome == ActionOutcome::kGraspLost) {
    held_.reset();
    keepMemory(std::nullopt);
  }
  if (held_ && !drive.done()) held_->kept.reset();
  if (drive.done()) visit_ = {};
  return result(drive);
}

Drive PlannerWork::closeOn(const PlacedObject& object, const KeptPlan& kept, const DriveWatch& watch) {
  const PickTarget& target = kept.request.target;
  keepMemory(PickMemory{object, target, ros::Time::now().toSec()});  // before: a crash may come at any time
  const Drive drive =
      driver_.closeGripper(std::max(0.0, target.part_width - parameters_.execution.squeeze), watch);
  if (drive.outcome == ActionOutcome::kFault) return drive;
  const GripperState state = driver_.gripper();
  if (!state.stalled || std::abs(state.width - target.part_width) > parameters_.execution.width_tolerance) {
    std::ostringstream text;
    text.precision(3);
    text << "the gripper closed to " << state.width * 1e3 << " mm" << (state.stalled ? " (stalled)" : "")
         << " and " << object.label() << " is " << target.part_width * 1e3 << " mm wide there";
    return {ActionOutcome::kGraspLost, text.str()};
  }
  hold(object, target, state.width);
  held_->kept = kept;
  scene_.takeAway(object);
  return drive;
}

bool PlannerWork::keptFits(int place, const JointVector& joints) const {
  if (!held_->kept || held_->kept->place != place) return false;
  const KeptPlan& kept = *held_->kept;
  const JointVector begin = kept.plan.motion(PickStage::kCarry).trajectory.points.front().position;
  if ((joints - begin).cwiseAbs().maxCoeff() > parameters_.execution.start_tolerance) return false;

  const CollisionWorld now = scene_.world(held_->object, place, inHand(joints));
  for (const PickStage stage : {PickStage::kCarry, PickStage::kLower, PickStage::kRetreat}) {
    const CollisionWorld world = worldOf(stage, now, kept.request, kept.plan);
    if (!firstCollision(world, kept.plan.motion(stage).trajectory, kRecheck).first.empty()) return false;
  }
  return true;
}

PickPlan PlannerWork::planThePlace(int place, const JointVector& joints, bool free) const {
  PlaceRequest request;
  request.start = joints;
  request.object = held_->object.label();
  request.tcp_from_object = held_->tcp_from_object;
  request.opening = held_->target.opening;
  request.part_width = held_->target.part_width;
  request.supports = {"table"};
  request.drops = dropTargets(places_[size_t(place)],
                              footprintOf(scene_.mesh(held_->object.name), held_->object.base_from_object),
                              held_->target.base_from_grasp, parameters_.drop_gap, parameters_.drop_above);
  const CollisionWorld world = scene_.world(held_->object, free ? place : -1, inHand(joints));
  return planPlace(arm_, world, request, parameters_.planning);
}

ActionResult PlannerWork::place(const PlaceGoal& goal, const WorkWatch& watch) {
  driver_.resetMotionTime();
  if (goal.place < 0 || goal.place >= int(places_.size()))
    return result(ActionOutcome::kUnreachable, noPlace(goal.place, places_.size()));

  recall();
  if (!held_)
    return result(
        ActionOutcome::kGraspLost,
        "the gripper holds nothing that was picked" +
            (holdsSomething(driver_.gripper()) ? ", and is not empty: " + recoverHint() : std::string()));
  if (const std::string gone = lost(driver_.gripper()); !gone.empty()) {
    held_.reset();
    return result(ActionOutcome::kGraspLost, gone);
  }

  watch.say("plan", 0);
  const ros::WallTime begin = ros::WallTime::now();
  const JointVector joints = start();
  PickPlan plan;
  if (keptFits(goal.place, joints)) {
    plan = afterLift(held_->kept->plan);
  } else {
    plan = planThePlace(goal.place, joints);
  }
  held_->kept.reset();
  const double planning_time = secondsSince(begin);
  watch.say("plan", 1);

  ActionResult ended = plan.planned()
                           ? drivePlace(goal.place, plan, watch)
                           : result(outcomeOf(plan.outcome), name(plan.outcome) + ": " + plan.reason);
  if (plan.outcome == PickOutcome::kStartInCollision) ended.reason += "; " + recoverHint();
  ended.planning_time = planning_time;
  return ended;
}

ActionResult PlannerWork::drivePlace(int place, const PickPlan& plan, const WorkWatch& watch) {
  watch.show(trajectoriesOf(plan.motions));
  if (watch.cancelled()) return result(ActionOutcome::kCancelled, "cancelled before anything moved");
  Drive drive;
  for (const PickMotion& motion : plan.motions) {
    if (motion.stage == PickStage::kRetreat) continue;
    const char* stage = motion.stage == PickStage::kLower ? "lower" : "carry";
    drive = driver_.follow(motion.trajectory, driveWatch(watch, stage, true));
    if (drive.outcome == ActionOutcome::kGraspLost) held_.reset();
    if (!drive.done()) return result(drive);
  }

  PlacedObject object = held_->object;
  const JointVector lowered = plan.motion(PickStage::kLower).trajectory.points.back().position;
  object.base_from_object = arm_.baseFromTcp(lowered) * held_->tcp_from_object;
  object.base_from_object.translation.z() -= parameters_.drop_gap;
  const double opening = held_->target.opening;
  visit_ = {object, opening};
  drive = driver_.openGripper(opening, driveWatch(watch, "open", false));
  if (drive.outcome == ActionOutcome::kFault) return result(drive);

  held_.reset();
  keepMemory(std::nullopt);
  scene_.putDown(place, object);
  if (drive.done())
    drive = driver_.follow(plan.motion(PickStage::kRetreat).trajectory, driveWatch(watch, "retreat", false));
  if (drive.done()) visit_ = {};
  return result(drive);
}

}  // namespace monocular_eye_hand
