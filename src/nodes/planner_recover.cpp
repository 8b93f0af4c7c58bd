// The way out: after a crash with a part in the hand, a gripper that is not empty, a start in collision.
#include <ros/console.h>
#include <ros/names.h>

#include <algorithm>
#include <cmath>

#include "nodes/names.h"
#include "nodes/planner_work.h"

namespace monocular_eye_hand {
namespace {

// What the gripper holds and nobody knows: a box from so far behind gripper_tcp to so far before it, so long
// along the pads. Large enough for most parts that fit the gripper [m].
constexpr double kUnknownBehind = 0.03, kUnknownBefore = 0.07, kUnknownLength = 0.06;
const char kUnknownPart[] = "unknown part";

std::string millimetres(double metres) { return std::to_string(std::lround(1e3 * metres)) + " mm"; }

}  // namespace

std::string PlannerWork::recoverHint() {
  return "a goal to " + ros::names::resolve(std::string("~") + names::kRecover) + " leads out";
}

bool PlannerWork::holdsSomething(const GripperState& gripper) const {
  return gripper.stalled && !gripper.moving && gripper.width > parameters_.execution.open_tolerance;
}

/// A planner that starts again knows what it picked last.
void PlannerWork::recall() {
  if (recalled_) return;
  const GripperState gripper = driver_.gripper();
  recalled_ = true;
  const std::optional<PickMemory> memory = keptMemory();
  if (!memory || !scene_.knows(memory->object.name)) return;
  if (memory->stamp > ros::Time::now().toSec() + parameters_.execution.joint_silence) return;  // another run
  const double off = std::abs(gripper.width - memory->target.part_width);
  if (holdsSomething(gripper) && off <= parameters_.execution.width_tolerance) {
    ROS_INFO("the gripper holds %s, picked before this node started", memory->object.label().c_str());
    hold(memory->object, memory->target, gripper.width);
  } else {
    visit_ = {memory->object, memory->target.opening};
  }
}

void PlannerWork::hold(const PlacedObject& object, const PickTarget& target, double width) {
  Held held;
  held.object = object;
  held.target = target;
  held.tcp_from_object = target.base_from_grasp.inverse() * object.base_from_object;
  held.width = width;
  held_ = held;
}

/// Something that was not picked by this node: it hangs in the hand as it is turned now.
void PlannerWork::holdUnknown(const GripperState& gripper, const JointVector& joints) {
  const double length = kUnknownBehind + kUnknownBefore;
  scene_.learnBox(kUnknownPart, {kUnknownLength, std::max(gripper.width, 1e-3), length});
  PickTarget target;
  target.object = std::string(kUnknownPart) + " 0";
  target.base_from_grasp = arm_.baseFromTcp(joints);
  target.base_from_grasp.translation.z() = parameters_.table.z + kUnknownBefore;
  target.base_from_pregrasp = target.base_from_lift = target.base_from_grasp;
  target.part_width = gripper.width;
  target.opening = description_.gripper_width_max;
  PlacedObject object{kUnknownPart, 0, target.base_from_grasp};
  object.base_from_object.translation +=
      target.base_from_grasp.rotation.col(2) * (kUnknownBefore - kUnknownBehind) / 2;
  hold(object, target, gripper.width);
}

CollisionWorld PlannerWork::worldNow(const JointVector& joints, double gripper_width) const {
  const std::optional<PlacedObject> subject =
      held_ ? std::optional<PlacedObject>(held_->object) : std::nullopt;
  CollisionWorld world = scene_.world(subject, -1, inHand(joints));
  if (held_) world.attach(held_->object.label(), held_->tcp_from_object);
  world.setGripperWidth(gripper_width);
  return world;
}

/// To the first place of the drop zone where nothing is known to stand.
ActionResult PlannerWork::putDownSomewhere(const WorkWatch& watch, std::string* said) {
  const std::string label = held_->object.label();
  const JointVector joints = start();
  std::string last = "the drop zone has no place";
  for (size_t place = 0; place < places_.size(); ++place) {
    const PickPlan plan = planThePlace(int(place), joints, false);
    if (!plan.planned()) {
      last = "place " + std::to_string(place) + ", " + name(plan.outcome) + ": " + plan.reason;
      continue;
    }
    *said += "put down " + label + " at place " + std::to_string(place) + "; ";
    return drivePlace(int(place), plan, watch);
  }
  return result(ActionOutcome::kUnreachable,
                *said + "no free place for " + label + " can be reached: " + last);
}

ActionResult PlannerWork::openHere(const WorkWatch& watch, std::string* said) {
  const JointVector joints = start();
  const double now = driver_.gripper().width;
  const double opening = freeOpening(worldNow(joints, now), joints, description_.gripper_width_max);
  *said += "opened the gripper";
  if (opening <= now + parameters_.execution.open_tolerance) return result(ActionOutcome::kDone, "");
  return result(driver_.openGripper(opening, driveWatch(watch, "open", false)));
}

ActionResult PlannerWork::recover(const WorkWatch& watch) {
  driver_.resetMotionTime();
  recall();
  watch.say("plan", 0);
  const ros::WallTime begin = ros::WallTime::now();
  const JointVector joints = start();
  const GripperState gripper = driver_.gripper();
  if (held_ && !lost(gripper).empty()) held_.reset();
  if (!held_ && holdsSomething(gripper)) holdUnknown(gripper, joints);
  if (held_) held_->kept.reset();

  const CollisionWorld world = worldNow(joints, gripper.width);
  TouchingPairs touching_pairs = touching(world);
  if (held_) touching_pairs.emplace_back(held_->object.label(), "table");
  const Departure departure = planRecovery(arm_, world, joints, touching_pairs, parameters_.planning);
  const double planning_time = (ros::WallTime::now() - begin).toSec();
  watch.say("plan", 1);

  std::string said;
  ActionResult ended = result(ActionOutcome::kDone, "");
  if (!departure.possible) {
    ended = result(ActionOutcome::kInCollision, departure.reason + "; move the arm away by hand");
  } else if (!departure.trajectory.points.empty()) {
    watch.show({departure.trajectory});
    const double way =
        (arm_.baseFromTcp(departure.end).translation - arm_.baseFromTcp(joints).translation).norm();
    said = "backed off by " + millimetres(way) + "; ";
    ended = result(driver_.follow(departure.trajectory, driveWatch(watch, "withdraw", held_.has_value())));
  }

  if (ended.done()) {
    const bool holds = held_.has_value();
    if (!holds) visit_ = {};
    ended = holds ? putDownSomewhere(watch, &said) : openHere(watch, &said);
    if (ended.done() && holds) said += "opened the gripper";
  }
  if (ended.done()) {
    ended.reason = said;
    keepMemory(std::nullopt);
  }
  ended.planning_time = planning_time;
  return ended;
}

}  // namespace monocular_eye_hand
