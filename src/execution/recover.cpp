#include <fmt/format.h>

// The way out: after a crash with a part in the hand, a gripper that is not empty, a start in collision.
#include <cmath>

#include "execution/stopwatch.h"
#include "monocular_eye_hand/execution/executor.h"

namespace monocular_eye_hand {
namespace {

std::string millimetres(double metres) { return fmt::format("{} mm", std::lround(1e3 * metres)); }

}  // namespace

ActionResult PickPlaceExecutor::recover(const ActionMonitor& monitor) {
  motion_.resetMotionTime();
  recall(monitor);

  monitor.reportProgress("plan", 0);
  const Stopwatch planning;
  const JointVector joints = start();
  const Departure departure = planTheRecovery(joints);
  const double planning_time = planning.seconds();
  monitor.reportProgress("plan", 1);

  std::string said;
  ActionResult ended = leave(departure, joints, monitor, &said);
  if (ended.done()) ended = emptyTheHand(monitor, &said);
  if (ended.done()) {
    ended.reason = said;
    memory_.keep(std::nullopt);
  }
  ended.planning_time = planning_time;
  return ended;
}

/// From here on it is known what the hand holds: nothing, what was picked, or an unknown part.
Departure PickPlaceExecutor::planTheRecovery(const JointVector& joints) {
  const GripperReading gripper = motion_.gripper();
  if (held_ && !lost(gripper).empty()) held_.reset();
  if (!held_ && holdsSomething(gripper)) holdUnknown(gripper, joints);
  if (held_) held_->kept.reset();

  const CollisionWorld world = worldNow(joints, gripper.width);
  TouchingPairs touching_pairs = touching(world);
  if (held_) touching_pairs.emplace_back(held_->object.label(), "table");
  return planRecovery(arm_, world, joints, touching_pairs, options_.planning);
}

/// Something that was not picked by this executor: it hangs in the hand as it is turned now.
void PickPlaceExecutor::holdUnknown(const GripperReading& gripper, const JointVector& joints) {
  scene_.learnBox(kUnknownPart, unknownPartSize(gripper.width));
  held_ = holdUnknownPart(arm_.baseFromTcp(joints), options_.table.z, gripper.width,
                          description_.gripper_width_max);
}

ActionResult PickPlaceExecutor::leave(const Departure& departure, const JointVector& joints,
                                      const ActionMonitor& monitor, std::string* said) {
  if (!departure.possible)
    return result(ActionOutcome::kInCollision, departure.reason + "; move the arm away by hand");
  if (departure.trajectory.points.empty()) return result(ActionOutcome::kDone, "");

  monitor.show({departure.trajectory});
  const Eigen::Vector3d way =
      arm_.baseFromTcp(departure.end).translation - arm_.baseFromTcp(joints).translation;
  *said += "backed off by " + millimetres(way.norm()) + "; ";
  return result(motion_.follow(departure.trajectory, motionMonitor(monitor, "withdraw", held_.has_value())));
}

ActionResult PickPlaceExecutor::emptyTheHand(const ActionMonitor& monitor, std::string* said) {
  if (!held_) {
    visit_ = {};
    return openHere(monitor, said);
  }
  const ActionResult ended = putDownSomewhere(monitor, said);
  if (ended.done()) *said += "opened the gripper";
  return ended;
}

/// To the first place of the drop zone where nothing is known to stand.
ActionResult PickPlaceExecutor::putDownSomewhere(const ActionMonitor& monitor, std::string* said) {
  const std::string label = held_->object.label();
  const JointVector joints = start();
  std::string last = "the drop zone has no place";
  for (size_t place = 0; place < places_.size(); ++place) {
    const PickPlan plan = planThePlace(int(place), joints, false);
    if (!plan.planned()) {
      last = fmt::format("place {}, {}: {}", place, toString(plan.outcome), plan.reason);
      continue;
    }
    *said += fmt::format("put down {} at place {}; ", label, place);
    return drivePlace(int(place), plan, monitor);
  }
  return result(ActionOutcome::kUnreachable,
                *said + "no free place for " + label + " can be reached: " + last);
}

ActionResult PickPlaceExecutor::openHere(const ActionMonitor& monitor, std::string* said) {
  const JointVector joints = start();
  const double now = motion_.gripper().width;
  const double opening = freeOpening(worldNow(joints, now), joints, description_.gripper_width_max);
  *said += "opened the gripper";
  if (opening <= now + options_.execution.open_tolerance) return result(ActionOutcome::kDone, "");
  return result(motion_.openGripper(opening, motionMonitor(monitor, "open", false)));
}

}  // namespace monocular_eye_hand
