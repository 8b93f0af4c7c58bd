#include "planning/pick_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

double timeTo(const Puma560Options& arm, const JointVector& a, const JointVector& b) {
  double time = 0;
  for (int i = 0; i < 6; ++i) time = std::max(time, std::abs(a[i] - b[i]) / arm.joints[i].velocity);
  return time;
}

/// The first collision of a polyline, in the order it is passed.
CollisionPair alongLine(const CollisionWorld& world, const std::vector<JointVector>& points) {
  const PathTest test = testIn(world);
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    const JointVector delta = points[i + 1] - points[i];
    const int steps = std::max(1, int(std::ceil(test.motion(delta) / (2 * test.padding))));
    for (int k = 0; k <= steps; ++k) {
      const JointVector joints = points[i] + delta * (double(k) / steps);
      if (!world.valid(joints)) return world.firstCollision(joints);
    }
  }
  return {};
}

}  // namespace

std::string describe(const CollisionPair& pair) {
  const bool apart = pair.distance > 0;
  return fmt::format("{} {} {} ({:.2g} mm {})", pair.first, apart ? "too near to" : "touches", pair.second,
                     std::abs(pair.distance) * 1e3, apart ? "away" : "deep");
}

void PickFailure::record(PickOutcome new_outcome, const std::string& new_reason) {
  if (int(new_outcome) <= progress) return;
  outcome = new_outcome;
  reason = new_reason;
  progress = int(new_outcome);
}

PickWorlds::PickWorlds(const CollisionWorld& world, const PickRequest& request, double padding,
                       double near_padding)
    : reach(world), approach(world), lift(world), carry(world) {
  const PickTarget& target = request.target;
  tcp_from_object = target.base_from_grasp.inverse() * world.pose(target.object);

  reach.setGripperWidth(target.opening);
  reach.setPadding(padding);

  approach.setGripperWidth(target.opening);
  approach.setPadding(near_padding);
  for (const std::string& finger : world.fingers()) approach.allow(finger, target.object);

  lift.setGripperWidth(target.part_width);
  lift.setPadding(near_padding);
  lift.setCarriedPadding(0);
  lift.attach(target.object, tcp_from_object);
  for (const std::string& support : request.supports) lift.allow(target.object, support);

  carry.setGripperWidth(target.part_width);
  carry.setPadding(padding);
  carry.setCarriedPadding(padding);
  carry.attach(target.object, tcp_from_object);
}

CollisionWorld PickWorlds::released(const PickRequest& request, const DropTarget& drop,
                                    double near_padding) const {
  CollisionWorld world = approach;
  for (const std::string& finger : world.fingers()) world.forbid(finger, request.target.object);
  world.move(request.target.object, drop.base_from_tcp * tcp_from_object);
  world.setPadding(near_padding);
  return world;
}

std::vector<JointVector> solutionsByTime(const ToolArm& arm, const Rigid3& base_from_tcp,
                                         const JointVector& current, int max_count) {
  ArmSolutions solutions;
  arm.inverse(base_from_tcp, current, &solutions);
  std::vector<JointVector> joints;
  for (const ArmSolution& s : solutions) joints.push_back(s.joints);
  std::stable_sort(joints.begin(), joints.end(), [&](const JointVector& a, const JointVector& b) {
    return timeTo(arm.arm.options(), a, current) < timeTo(arm.arm.options(), b, current);
  });
  if (int(joints.size()) > max_count) joints.resize(size_t(max_count));
  return joints;
}

std::vector<JointVector> straightLine(const ToolArm& arm, const CollisionWorld& world,
                                      const JointVector& start, const Rigid3& base_from_tcp,
                                      const PlanningOptions& options, PickOutcome unreachable,
                                      PickOutcome blocked, const char* what, PickFailure* failure) {
  CartesianPath line = cartesianPath(arm, start, base_from_tcp, options.cartesian);
  if (!line.found()) {
    failure->record(unreachable, std::string(what) + ": " + line.reason);
    return {};
  }
  const CollisionPair hit = alongLine(world, line.points);
  if (!hit.first.empty()) {
    failure->record(blocked, std::string(what) + ": " + describe(hit));
    return {};
  }
  return line.points;
}

bool graspWay(const ToolArm& arm, const PickWorlds& worlds, const PickTarget& target,
              const JointVector& before, const PlanningOptions& options, GraspWay* way,
              PickFailure* failure) {
  if (!worlds.reach.valid(before)) {
    failure->record(PickOutcome::kGraspInCollision,
                    "pre-grasp: " + describe(worlds.reach.firstCollision(before)));
    return false;
  }

  way->before = before;
  way->approach =
      straightLine(arm, worlds.approach, before, target.base_from_grasp, options,
                   PickOutcome::kGraspUnreachable, PickOutcome::kApproachBlocked, "approach", failure);
  if (way->approach.empty()) return false;
  way->lift = straightLine(arm, worlds.lift, way->approach.back(), target.base_from_lift, options,
                           PickOutcome::kGraspUnreachable, PickOutcome::kLiftBlocked, "lift", failure);
  if (way->lift.empty()) return false;

  if (worlds.carry.valid(way->lift.back())) return true;
  failure->record(PickOutcome::kLiftBlocked,
                  "end of the lift: " + describe(worlds.carry.firstCollision(way->lift.back())));
  return false;
}

/// Back out of the grasp, as it was approached: straight up the fingers of a tilted hand would catch the
/// part. Where that is blocked, the way it came.
std::vector<JointVector> retreatWay(const ToolArm& arm, const CollisionWorld& released,
                                    const DropTarget& drop, const std::vector<JointVector>& lower,
                                    const PlanningOptions& options, PickFailure* failure) {
  const double distance = (drop.base_from_tcp_above.translation - drop.base_from_tcp.translation).norm();
  Rigid3 back = drop.base_from_tcp;
  back.translation -= distance * back.rotation.col(2);
  PickFailure blocked;
  std::vector<JointVector> way =
      straightLine(arm, released, lower.back(), back, options, PickOutcome::kDropUnreachable,
                   PickOutcome::kLoweringBlocked, "retreat from the drop", &blocked);
  if (!way.empty()) return way;
  way.assign(lower.rbegin(), lower.rend());
  if (alongLine(released, way).first.empty()) return way;
  failure->record(PickOutcome::kLoweringBlocked, blocked.reason);
  return {};
}

bool dropWay(const ToolArm& arm, const PickWorlds& worlds, const CollisionWorld& released,
             const DropTarget& drop, const JointVector& above, const PlanningOptions& options, DropWay* way,
             PickFailure* failure) {
  if (!worlds.carry.valid(above)) {
    failure->record(PickOutcome::kDropInCollision,
                    "above the drop: " + describe(worlds.carry.firstCollision(above)));
    return false;
  }
  way->above = above;
  way->lower =
      straightLine(arm, worlds.lift, above, drop.base_from_tcp, options, PickOutcome::kDropUnreachable,
                   PickOutcome::kLoweringBlocked, "lowering", failure);
  if (way->lower.empty()) return false;
  way->retreat = retreatWay(arm, released, drop, way->lower, options, failure);
  return !way->retreat.empty();
}

}  // namespace monocular_eye_hand
