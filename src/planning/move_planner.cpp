#include "monocular_eye_hand/planning/move_planner.h"

#include <fmt/format.h>

#include <algorithm>

#include "monocular_eye_hand/geometry/error.h"
#include "planning/limits.h"
#include "planning/pick_ways.h"

namespace monocular_eye_hand {
namespace {

constexpr double kThere = 1e-6;  // no motion is needed for less [rad]

class Mover {
 public:
  Mover(const ToolArm& arm, const CollisionWorld& world, const MoveRequest& request,
        const PlanningOptions& options)
      : arm_(arm), world_(world), request_(request), options_(options) {}

  MovePlan run() {
    const Departure departure = planDeparture(arm_, world_, request_.start, request_.touching, options_);
    if (!departure.possible) {
      record(MoveOutcome::kStartInCollision, departure.reason);
      return plan_;
    }
    if (runFrom(departure) || plan_.outcome != MoveOutcome::kNoPath) return plan_;
    for (const Departure& withdrawal :
         planWithdrawals(arm_, world_, request_.start, request_.touching, options_))
      if (runFrom(withdrawal)) return plan_;
    return plan_;
  }

 private:
  bool runFrom(const Departure& departure) {
    failed_searches_ = 0;
    at_ = departure.end;
    world_.setPadding(departure.padding);
    world_.setCarriedPadding(departure.padding);
    plan_.motions.clear();
    if (!departure.trajectory.points.empty()) plan_.motions.push_back(departure.trajectory);
    for (size_t i = 0; i < request_.joints.size(); ++i)
      if (reach({request_.joints[i]}, int(i), "the joint angles")) return true;
    for (size_t i = 0; request_.joints.empty() && i < request_.base_from_tcp.size(); ++i) {
      const std::string what = fmt::format("pose {}", i);
      const auto goals = solutionsByTime(arm_, request_.base_from_tcp[i], at_, options_.candidates);
      if (goals.empty()) record(MoveOutcome::kUnreachable, what + ": out of reach or joint limits");
      if (!goals.empty() && reach(goals, int(i), what)) return true;
    }
    plan_.motions.clear();
    return false;
  }

  /// Of all failures the one that came furthest is reported.
  void record(MoveOutcome outcome, const std::string& reason) {
    if (!plan_.reason.empty() && outcome <= plan_.outcome) return;
    plan_.outcome = outcome;
    plan_.reason = reason;
  }

  bool reach(const std::vector<JointVector>& goals, int index, const std::string& what) {
    std::vector<JointVector> free;
    for (const JointVector& goal : goals) {
      if (!arm_.arm.withinLimits(goal))
        record(MoveOutcome::kUnreachable, what + ": outside the joint limits");
      else if (!world_.valid(goal))
        record(MoveOutcome::kGoalInCollision, what + ": " + describe(world_.firstCollision(goal)));
      else
        free.push_back(goal);
    }
    if (free.empty() || failed_searches_ >= kFailedSearches) return false;

    PathOptions options = options_.path;
    options.budget = std::max(1, options.budget / kFailedSearches);
    const JointPath path = planPath(arm_.arm.options().joints, at_, free, testIn(world_), options);
    if (!path.found()) {
      ++failed_searches_;
      record(MoveOutcome::kNoPath,
             fmt::format("{}: no free path found in {} tests (budget {})", what, path.tests, options.budget));
      return false;
    }

    if ((path.points.back() - at_).norm() > kThere)
      plan_.motions.push_back(timeParameterise(arm_, path.points, testIn(world_), options_.timing));
    plan_.outcome = MoveOutcome::kPlanned;
    plan_.reason.clear();
    plan_.goal = index;
    return true;
  }

  const ToolArm& arm_;
  CollisionWorld world_;
  const MoveRequest& request_;
  const PlanningOptions& options_;
  MovePlan plan_;
  JointVector at_ = JointVector::Zero();  // where the free motion begins
  int failed_searches_ = 0;
};

}  // namespace

std::string toString(MoveOutcome outcome) {
  switch (outcome) {
    case MoveOutcome::kPlanned:
      return "planned";
    case MoveOutcome::kStartInCollision:
      return "start in collision";
    case MoveOutcome::kUnreachable:
      return "unreachable";
    case MoveOutcome::kGoalInCollision:
      return "goal in collision";
    case MoveOutcome::kNoPath:
      return "no path";
  }
  return "unknown";
}

ActionOutcome outcomeOf(MoveOutcome outcome) {
  switch (outcome) {
    case MoveOutcome::kPlanned:
      return ActionOutcome::kDone;
    case MoveOutcome::kStartInCollision:
    case MoveOutcome::kGoalInCollision:
      return ActionOutcome::kInCollision;
    case MoveOutcome::kUnreachable:
    case MoveOutcome::kNoPath:
      break;
  }
  return ActionOutcome::kUnreachable;
}

MovePlan planMove(const ToolArm& arm, const CollisionWorld& world, const MoveRequest& request,
                  const PlanningOptions& options) {
  options.check();
  if (request.base_from_tcp.empty() == request.joints.empty())
    throw BadInput("a motion needs poses or joint angles, and not both");
  for (const Rigid3& pose : request.base_from_tcp)
    if (!pose.isFinite()) throw BadInput("a pose is not finite");
  for (const JointVector& joints : request.joints)
    if (!joints.allFinite()) throw BadInput("joint angles are not finite");
  return Mover(arm, world, request, options).run();
}

}  // namespace monocular_eye_hand
