#include <fmt/format.h>

#include <algorithm>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/planning/move_planner.h"
#include "planning/limits.h"
#include "planning/pick_ways.h"

namespace monocular_eye_hand {
namespace {

void requireRequest(const CollisionWorld& world, const ToolArm& arm, const PlaceRequest& request) {
  if (!world.has(request.object)) throw BadInput("the object \"" + request.object + "\" is not in the world");
  if (!world.carried().empty()) throw BadInput("the world says that " + world.carried() + " is carried");
  for (const std::string& support : request.supports)
    if (!world.has(support)) throw BadInput("the support \"" + support + "\" is not in the world");
  if (!request.start.allFinite()) throw BadInput("the start joints are not finite");
  if (!arm.arm.withinLimits(request.start)) throw BadInput("the start joints are outside their limits");
  if (request.drops.empty()) throw BadInput("there is no drop pose");
  bool finite = request.tcp_from_object.isFinite();
  for (const DropTarget& drop : request.drops)
    finite &= drop.base_from_tcp.isFinite() && drop.base_from_tcp_above.isFinite();
  if (!finite) throw BadInput("a pose of gripper_tcp or of the object is not finite");
  for (double width : {request.opening, request.part_width})
    if (!(width >= 0 && width <= 1)) throw BadInput("the gripper's width must be 0 to 1 m");
}

/// The pick that would have ended where the object is held now: it says which worlds to plan in.
PickRequest pickBefore(const PlaceRequest& request, const Rigid3& base_from_tcp) {
  PickRequest pick;
  pick.start = request.start;
  pick.target.object = request.object;
  pick.target.base_from_pregrasp = pick.target.base_from_grasp = pick.target.base_from_lift = base_from_tcp;
  pick.target.opening = request.opening;
  pick.target.part_width = request.part_width;
  pick.drops = request.drops;
  pick.supports = request.supports;
  return pick;
}

class Placer {
 public:
  Placer(const ToolArm& arm, const CollisionWorld& world, const PickRequest& pick, const Departure& departure,
         const PlanningOptions& options)
      : arm_(arm),
        pick_(pick),
        departure_(departure),
        options_(options),
        worlds_(world, pick, departure.padding, options.near_padding) {}

  PickPlan run() {
    for (size_t k = 0; k < pick_.drops.size(); ++k)
      if (put(int(k))) return plan_;
    plan_.outcome = failure_.outcome;
    plan_.reason = failure_.reason;
    return plan_;
  }

 private:
  bool put(int k) {
    const DropTarget& drop = pick_.drops[size_t(k)];
    const auto solutions =
        solutionsByTime(arm_, drop.base_from_tcp_above, departure_.end, options_.candidates);
    if (solutions.empty())
      failure_.record(PickOutcome::kDropUnreachable, "above the drop: out of reach or joint limits");
    const CollisionWorld released = worlds_.released(pick_, drop, options_.near_padding);
    for (const JointVector& above : solutions) {
      DropWay way;
      if (!dropWay(arm_, worlds_, released, drop, above, options_, &way, &failure_)) continue;
      const JointPath carry = search(above);
      if (!carry.found()) continue;
      plan_.drop = k;
      plan_.configuration = arm_.arm.configuration(way.lower.back());
      compose(carry, way, released);
      return true;
    }
    return false;
  }

  JointPath search(const JointVector& above) {
    if (failed_searches_ >= kFailedSearches) return {};
    PathOptions options = options_.path;
    options.budget = std::max(1, options.budget / kFailedSearches);
    const JointPath path =
        planPath(arm_.arm.options().joints, departure_.end, {above}, testIn(worlds_.carry), options);
    if (path.found()) return path;
    ++failed_searches_;
    failure_.record(
        PickOutcome::kNoPathToDrop,
        fmt::format("no free path to the drop found in {} tests (budget {})", path.tests, options.budget));
    return path;
  }

  void compose(const JointPath& carry, const DropWay& way, const CollisionWorld& released) {
    const double open = pick_.target.opening, grip = pick_.target.part_width;
    TimingOptions near = options_.timing;
    near.tool_speed = std::min(options_.near_speed, near.tool_speed);
    near.corner = std::min(kNearCorner, near.corner);
    const auto add = [&](PickStage stage, const std::vector<JointVector>& path, const CollisionWorld& world,
                         double width, const TimingOptions& timing) {
      plan_.motions.push_back({stage, timeParameterise(arm_, path, testIn(world), timing), width});
    };
    if (!departure_.trajectory.points.empty())
      plan_.motions.push_back({PickStage::kLift, departure_.trajectory, grip});
    add(PickStage::kCarry, carry.points, worlds_.carry, grip, options_.timing);
    add(PickStage::kLower, way.lower, worlds_.lift, grip, near);
    add(PickStage::kRetreat, way.retreat, released, open, near);
  }

  const ToolArm& arm_;
  const PickRequest& pick_;
  const Departure& departure_;
  const PlanningOptions& options_;
  PickWorlds worlds_;
  PickFailure failure_;
  PickPlan plan_;
  int failed_searches_ = 0;
};

}  // namespace

PickPlan planPlace(const ToolArm& arm, const CollisionWorld& world, const PlaceRequest& request,
                   const PlanningOptions& options) {
  options.check();
  requireRequest(world, arm, request);

  const Rigid3 base_from_tcp = arm.baseFromTcp(request.start);
  CollisionWorld held = world;
  held.setGripperWidth(request.part_width);
  held.attach(request.object, request.tcp_from_object);
  TouchingPairs touching;
  for (const std::string& support : request.supports) touching.emplace_back(request.object, support);
  const Departure departure = planDeparture(arm, held, request.start, touching, options);
  if (!departure.possible) {
    PickPlan plan;
    plan.outcome = PickOutcome::kStartInCollision;
    plan.reason = departure.reason;
    return plan;
  }

  CollisionWorld standing = world;
  standing.move(request.object, base_from_tcp * request.tcp_from_object);
  const PickRequest pick = pickBefore(request, base_from_tcp);
  const PickPlan plan = Placer(arm, standing, pick, departure, options).run();
  if (plan.outcome != PickOutcome::kNoPathToDrop) return plan;

  for (const Departure& withdrawal : planWithdrawals(arm, held, request.start, touching, options)) {
    const PickPlan later = Placer(arm, standing, pick, withdrawal, options).run();
    if (later.planned()) return later;
  }
  return plan;
}

}  // namespace monocular_eye_hand
