#include "monocular_eye_hand/planning/path_planner.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Values = ob::RealVectorStateSpace::StateType;

JointVector jointsOf(const ob::State* state) {
  return Eigen::Map<const JointVector>(state->as<Values>()->values);
}

/// OMPL's own generators take their seeds from one global sequence, so a path would depend on what was
/// planned before; this one starts anew with every plan.
class SeededSampler : public ob::StateSampler {
 public:
  SeededSampler(const ob::StateSpace* space, int seed) : StateSampler(space), random_(seed) {}
  void sampleUniform(ob::State* state) override {
    const ob::RealVectorBounds& bounds = space_->as<ob::RealVectorStateSpace>()->getBounds();
    for (int i = 0; i < 6; ++i)
      state->as<Values>()->values[i] = bounds.low[i] + (bounds.high[i] - bounds.low[i]) * unit();
  }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    for (int i = 0; i < 6; ++i)
      state->as<Values>()->values[i] = near->as<Values>()->values[i] + distance * (2 * unit() - 1);
    space_->enforceBounds(state);
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    std::normal_distribution<double> normal(0, deviation);
    for (int i = 0; i < 6; ++i)
      state->as<Values>()->values[i] = mean->as<Values>()->values[i] + normal(random_);
    space_->enforceBounds(state);
  }

 private:
  double unit() { return double(random_() >> 11) / 9007199254740992.0; }
  std::mt19937_64 random_;
};

class Edges : public ob::MotionValidator {
 public:
  Edges(const ob::SpaceInformationPtr& si, const PathTest& test, double resolution, bool exact, int* tests)
      : MotionValidator(si), test_(test), resolution_(resolution), exact_(exact), tests_(tests) {}
  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return edgeFree(test_, jointsOf(a), jointsOf(b), resolution_, exact_, tests_);
  }
  bool checkMotion(const ob::State* a, const ob::State* b,
                   std::pair<ob::State*, double>& last) const override {
    const bool free = checkMotion(a, b);
    last.second = free ? 1 : 0;
    if (last.first) si_->copyState(last.first, free ? b : a);
    return free;
  }

 private:
  const PathTest& test_;
  double resolution_;
  bool exact_;
  int* tests_;
};

struct Query {
  const std::array<JointLimit, 6>& limits;
  const JointVector& start;
  const std::vector<JointVector>& goals;
  const PathTest& test;
  const PathOptions& options;
};

ob::SpaceInformationPtr spaceOf(const Query& query, bool exact, int* tests) {
  const auto space = std::make_shared<ob::RealVectorStateSpace>(6);
  ob::RealVectorBounds bounds(6);
  for (int i = 0; i < 6; ++i) {
    bounds.setLow(i, query.limits[i].lower);
    bounds.setHigh(i, query.limits[i].upper);
  }
  space->setBounds(bounds);
  const int seed = query.options.seed;
  space->setStateSamplerAllocator(
      [seed](const ob::StateSpace* s) { return std::make_shared<SeededSampler>(s, seed); });

  const auto si = std::make_shared<ob::SpaceInformation>(space);
  const JointTest& valid = query.test.valid;
  si->setStateValidityChecker([&valid, tests](const ob::State* s) {
    ++*tests;
    return valid(jointsOf(s));
  });
  si->setMotionValidator(std::make_shared<Edges>(si, query.test, query.options.resolution, exact, tests));
  si->setup();
  return si;
}

/// The corners of a path, none when the budget is used up.
std::vector<JointVector> search(const Query& query, bool exact, int* tests) {
  const ob::SpaceInformationPtr si = spaceOf(query, exact, tests);
  const auto problem = std::make_shared<ob::ProblemDefinition>(si);
  ob::ScopedState<ob::RealVectorStateSpace> state(si->getStateSpace());
  for (int i = 0; i < 6; ++i) state[i] = query.start[i];
  problem->addStartState(state);

  const auto goals = std::make_shared<ob::GoalStates>(si);
  for (const JointVector& goal : query.goals) {
    for (int i = 0; i < 6; ++i) state[i] = goal[i];
    goals->addState(state);
  }
  problem->setGoal(goals);

  og::RRTConnect planner(si);
  planner.setRange(query.options.range);
  planner
      .setNearestNeighbors<ompl::NearestNeighborsLinear>();  // GNAT picks its pivots from the global sequence
  planner.setProblemDefinition(problem);
  planner.setup();

  const int budget = query.options.budget;
  // A tree without room to grow spends little on tests; its rounds count too.
  int rounds = 0;
  const ob::PlannerTerminationCondition spent([&] { return *tests + ++rounds > budget; });
  if (planner.solve(spent) != ob::PlannerStatus::EXACT_SOLUTION) return {};

  std::vector<JointVector> points;
  for (const ob::State* s : problem->getSolutionPath()->as<og::PathGeometric>()->getStates())
    points.push_back(jointsOf(s));
  return points;
}

bool inside(const std::array<JointLimit, 6>& limits, const JointVector& joints) {
  for (int i = 0; i < 6; ++i)
    if (joints[i] < limits[i].lower - 1e-9 || joints[i] > limits[i].upper + 1e-9) return false;
  return true;
}

bool allFree(const std::vector<JointVector>& points, const PathTest& test, double resolution, int* tests) {
  for (size_t i = 0; i + 1 < points.size(); ++i)
    if (!edgeFree(test, points[i], points[i + 1], resolution, true, tests)) return false;
  return true;
}

int nearestGoal(const JointVector& end, const std::vector<JointVector>& goals) {
  const auto nearer = [&](const JointVector& a, const JointVector& b) {
    return (a - end).norm() < (b - end).norm();
  };
  return int(std::min_element(goals.begin(), goals.end(), nearer) - goals.begin());
}

}  // namespace

JointPath planPath(const std::array<JointLimit, 6>& limits, const JointVector& start,
                   const std::vector<JointVector>& goals, const PathTest& test, const PathOptions& options) {
  options.check();
  if (!test.valid) throw BadInput("planPath() needs a test of joint vectors");
  if (goals.empty()) throw BadInput("planPath() needs a goal");
  if (!start.allFinite()) throw BadInput("the start joints are not finite");
  for (const JointVector& goal : goals)
    if (!goal.allFinite()) throw BadInput("the goal joints are not finite");
  for (const JointLimit& limit : limits) limit.check();
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);

  JointPath path;
  const auto end = [&path](PathOutcome outcome) {
    path.outcome = outcome;
    return path;
  };
  const auto collides = [&path, &test](const JointVector& joints) {
    ++path.tests;
    return !test.valid(joints);
  };
  if (!inside(limits, start)) return end(PathOutcome::kOutsideLimits);
  if (collides(start)) return end(PathOutcome::kStartInCollision);

  std::vector<JointVector> usable;
  PathOutcome refused = PathOutcome::kFound;
  for (const JointVector& goal : goals) {
    PathOutcome outcome = PathOutcome::kFound;
    if (!inside(limits, goal))
      outcome = PathOutcome::kOutsideLimits;
    else if (collides(goal))
      outcome = PathOutcome::kGoalInCollision;
    if (outcome == PathOutcome::kFound)
      usable.push_back(goal);
    else if (refused == PathOutcome::kFound)
      refused = outcome;
  }
  if (usable.empty()) return end(refused);

  PathOptions finer = options;
  for (int attempt = 0; attempt < 3; ++attempt) {
    // What the coarse steps missed is searched again with finer ones, at last with steps that miss nothing.
    const bool exact = attempt == 2;
    std::vector<JointVector> points;
    for (const JointVector& goal : usable)
      if (points.empty() && edgeFree(test, start, goal, finer.resolution, exact, &path.tests))
        points = {start, goal};
    if (points.empty()) points = search({limits, start, usable, test, finer}, exact, &path.tests);
    if (points.empty()) return end(PathOutcome::kNoPath);
    std::vector<JointVector> shorter = points;
    shorten(&shorter, test, finer, &path.tests);
    if (allFree(shorter, test, finer.resolution, &path.tests))
      path.points = shorter;
    else if (allFree(points, test, finer.resolution, &path.tests))
      path.points = points;
    if (!path.points.empty()) {
      path.goal = nearestGoal(path.points.back(), goals);
      return end(PathOutcome::kFound);
    }
    finer.resolution /= 4;
  }
  return end(PathOutcome::kNoPath);
}

}  // namespace monocular_eye_hand
