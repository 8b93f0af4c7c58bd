#include "nodes/planner_work.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSweepStep = 0.002;  // of the gripper's width between two tests [m]
constexpr double kLimitSlack = 2e-3;  // a joint may stand so far beyond its limit [rad]

}  // namespace

PlannerWork::PlannerWork(const PlannerParameters& parameters)
    : parameters_(parameters),
      description_(loadArmDescription(parameters.urdf)),
      arm_{Puma560(parameters.arm), description_.tool0_from_tcp},
      places_(parameters.drop_zone.places()),
      scene_(description_, parameters),
      driver_(parameters.execution, parameters.feedback_period) {
  requireSameArm(description_, arm_.arm);
}

std::vector<std::string> PlannerWork::see(const std::vector<PlacedObject>& objects) {
  seen_ = true;
  return scene_.see(objects);
}

ActionResult PlannerWork::result(ActionOutcome outcome, const std::string& reason) const {
  ActionResult result;
  result.outcome = outcome;
  result.reason = reason;
  result.motion_time = driver_.motionTime();
  result.stamp = driver_.jointStamp();
  return result;
}

ActionResult PlannerWork::refuse(const std::string& what) const {
  return result(ActionOutcome::kFault, "bad goal: " + what + "; nothing moved");
}

ActionResult PlannerWork::result(const Drive& drive) const { return result(drive.outcome, drive.reason); }

JointVector PlannerWork::start() const {
  JointVector joints = driver_.joints();
  for (int i = 0; i < 6; ++i) {
    const JointLimit& limit = arm_.arm.options().joints[size_t(i)];
    const double inside = std::clamp(joints[i], limit.lower, limit.upper);
    if (std::abs(inside - joints[i]) > kLimitSlack)
      throw BadInput("joint" + std::to_string(i + 1) + " stands at " + std::to_string(joints[i]) +
                     " rad, outside its limits: move it back by hand");
    joints[i] = inside;
  }
  return joints;
}

TouchingPairs PlannerWork::touching(const CollisionWorld& world) const {
  TouchingPairs pairs;
  if (!visit_.object) return pairs;
  for (const std::string& label : scene_.labels(*visit_.object))
    if (world.has(label))
      for (const std::string& finger : world.fingers()) pairs.emplace_back(finger, label);
  return pairs;
}

/// What the fingers would touch on their way from one width to the other; "" for nothing.
std::string PlannerWork::sweep(const CollisionWorld& world, const JointVector& joints, double from,
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
double PlannerWork::freeOpening(const CollisionWorld& world, const JointVector& joints, double wanted) const {
  const double now = driver_.gripper().width;
  if (wanted <= now) return wanted;
  for (double width = wanted; width > now; width -= kSweepStep)
    if (sweep(world, joints, width, width).empty()) return width;
  return now;
}

std::string PlannerWork::lost(const GripperState& state) const {
  if (!held_) return "";
  const double off = std::abs(state.width - held_->width);
  if (state.stalled && off <= parameters_.execution.width_tolerance) return "";
  std::ostringstream text;
  text.precision(3);
  text << "the gripper lost " << held_->object.label() << ": it stands at " << state.width * 1e3
       << " mm and held it at " << held_->width * 1e3 << " mm";
  return text.str();
}

/// The held object as the hand has it at these joints.
std::optional<PlacedObject> PlannerWork::inHand(const JointVector& joints) const {
  if (!held_) return std::nullopt;
  PlacedObject object = held_->object;
  object.base_from_object = arm_.baseFromTcp(joints) * held_->tcp_from_object;
  return object;
}

DriveWatch PlannerWork::driveWatch(const WorkWatch& watch, const std::string& stage, bool holding) const {
  DriveWatch drive;
  drive.cancelled = watch.cancelled;
  drive.feedback = [say = watch.say, stage](double progress) { say(stage, progress); };
  if (holding) drive.lost = [this](const GripperState& state) { return lost(state); };
  return drive;
}

}  // namespace monocular_eye_hand
