#include "monocular_eye_hand/execution/executor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSweepStep = 0.002;  // of the gripper's width between two tests [m]
constexpr double kLimitSlack = 2e-3;  // a joint may stand so far beyond its limit [rad]

}  // namespace

PickPlaceExecutor::PickPlaceExecutor(const ExecutorOptions& options, Robot* robot, PickMemoryStore* memory,
                                     const ExecutorTexts& texts)
    : options_(options),
      texts_(texts),
      description_(loadArmDescription(options.urdf)),
      arm_{Puma560(options.arm), description_.tool0_from_tcp},
      places_(options.drop_zone.places()),
      scene_(description_, options),
      motion_(robot, options.execution, options.feedback_period),
      memory_(*memory) {
  requireSameArm(description_, arm_.arm);
}

std::vector<std::string> PickPlaceExecutor::see(const std::vector<PlacedObject>& objects) {
  seen_ = true;
  return scene_.see(objects);
}

ActionResult PickPlaceExecutor::refuse(ActionOutcome outcome, const std::string& reason) {
  motion_.resetMotionTime();
  return result(outcome, reason);
}

ActionResult PickPlaceExecutor::refuseBadGoal(const std::string& what) {
  return refuse(ActionOutcome::kFault, "bad goal: " + what + "; nothing moved");
}

ActionResult PickPlaceExecutor::noPlace(int place) {
  return refuse(
      ActionOutcome::kUnreachable,
      fmt::format("there is no place {}: the drop zone has {}, counted from 0", place, places_.size()));
}

ActionResult PickPlaceExecutor::result(ActionOutcome outcome, const std::string& reason) const {
  ActionResult result;
  result.outcome = outcome;
  result.reason = reason;
  result.motion_time = motion_.motionTime();
  result.stamp = motion_.jointStamp();
  return result;
}

ActionResult PickPlaceExecutor::result(const MotionResult& moved) const {
  return result(moved.outcome, moved.reason);
}

MotionMonitor PickPlaceExecutor::motionMonitor(const ActionMonitor& monitor, const std::string& stage,
                                               bool holding) const {
  MotionMonitor motion;
  motion.cancelled = monitor.cancelled;
  motion.reportProgress = [report = monitor.reportProgress, stage](double progress) {
    report(stage, progress);
  };
  if (holding) motion.lost = [this](const GripperReading& gripper) { return lost(gripper); };
  return motion;
}

/// Where the arm is, within its limits. Throws BadInput when it is silent or stands beyond them.
JointVector PickPlaceExecutor::start() const {
  JointVector joints = motion_.joints();
  for (int i = 0; i < 6; ++i) {
    const JointLimit& limit = arm_.arm.options().joints[size_t(i)];
    const double inside = std::clamp(joints[i], limit.lower, limit.upper);
    if (std::abs(inside - joints[i]) > kLimitSlack)
      throw BadInput(fmt::format("joint{} stands at {:.3f} rad, outside its limits: move it back by hand",
                                 i + 1, joints[i]));
    joints[i] = inside;
  }
  return joints;
}

/// With what is held in the hand.
CollisionWorld PickPlaceExecutor::worldNow(const JointVector& joints, double gripper_width) const {
  CollisionWorld world = scene_.world(heldObject(), -1, inHand(joints));
  if (held_) world.attach(held_->object.label(), held_->tcp_from_object);
  world.setGripperWidth(gripper_width);
  return world;
}

TouchingPairs PickPlaceExecutor::touching(const CollisionWorld& world) const {
  TouchingPairs pairs;
  if (!visit_.object) return pairs;
  for (const std::string& label : scene_.labels(*visit_.object))
    if (world.has(label))
      for (const std::string& finger : world.fingers()) pairs.emplace_back(finger, label);
  return pairs;
}

/// What the fingers would touch on their way from one width to the other; "" for nothing.
std::string PickPlaceExecutor::sweep(const CollisionWorld& world, const JointVector& joints, double from,
                                     double to) const {
  CollisionWorld bare = world;
  bare.setPadding(0);
  bare.setCarriedPadding(0);
  for (const auto& pair : touching(world)) bare.allow(pair.first, pair.second);

  const int steps = std::max(1, int(std::ceil(std::abs(to - from) / kSweepStep)));
  for (int i = 0; i <= steps; ++i) {
    bare.setGripperWidth(from + (to - from) * i / steps);
    const CollisionPair hit = bare.firstCollision(joints);
    if (!hit.first.empty()) return hit.first + " touches " + hit.second;
  }
  return "";
}

/// The widest opening up to `wanted` that the fingers can take here.
double PickPlaceExecutor::freeOpening(const CollisionWorld& world, const JointVector& joints,
                                      double wanted) const {
  const double now = motion_.gripper().width;
  if (wanted <= now) return wanted;
  for (double width = wanted; width > now; width -= kSweepStep)
    if (sweep(world, joints, width, width).empty()) return width;
  return now;
}

/// An executor that starts again knows what was picked last.
void PickPlaceExecutor::recall(const ActionMonitor& monitor) {
  if (recalled_) return;
  const GripperReading gripper = motion_.gripper();
  recalled_ = true;
  const std::optional<PickMemory> memory = memory_.kept();
  if (!memory || !scene_.knows(memory->object.name)) return;
  if (memory->stamp > motion_.clock() + options_.execution.joint_silence) return;  // of another run

  const double off = std::abs(gripper.width - memory->target.part_width);
  if (holdsSomething(gripper) && off <= options_.execution.width_tolerance) {
    monitor.log("the gripper holds " + memory->object.label() + ", picked before this node started");
    held_ = holdPart(memory->object, memory->target, gripper.width);
  } else {
    visit_ = {memory->object, memory->target.opening};
  }
}

bool PickPlaceExecutor::holdsSomething(const GripperReading& gripper) const {
  return gripper.stalled && !gripper.moving && gripper.width > options_.execution.open_tolerance;
}

std::string PickPlaceExecutor::lost(const GripperReading& gripper) const {
  return held_ ? held_->lost(gripper, options_.execution.width_tolerance) : "";
}

/// What is held, as it stood.
std::optional<PlacedObject> PickPlaceExecutor::heldObject() const {
  return held_ ? std::optional<PlacedObject>(held_->object) : std::nullopt;
}

/// What is held, as the hand has it at these joints.
std::optional<PlacedObject> PickPlaceExecutor::inHand(const JointVector& joints) const {
  return held_ ? std::optional<PlacedObject>(held_->inHand(arm_.baseFromTcp(joints))) : std::nullopt;
}

/// Nothing is held, nor will be after a restart.
void PickPlaceExecutor::letGo() {
  held_.reset();
  memory_.keep(std::nullopt);
}

}  // namespace monocular_eye_hand
