#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/planning/move_planner.h"
#include "planning/pick_ways.h"

namespace monocular_eye_hand {
namespace {

constexpr double kStep = 5e-4;  // of any point of the arm between two tests of true shapes [m]
constexpr double kLengths[] = {0.01, 0.02, 0.05, 0.1};                // of a straight way out [m]
constexpr double kWithdrawals[] = {0.1, 0.05};                        // out of a narrow place [m]
constexpr double kRecoveries[] = {0.01, 0.02, 0.05, 0.1, 0.15, 0.2};  // out of a collision [m]
constexpr int kMaxMet = 20;                                           // pairs that meet where the arm stands
constexpr int kPartingSteps = 4;                                      // between two points of a way
constexpr double kTurns[] = {0.05, 0.1, 0.2};                         // of a single joint [rad]

void pad(CollisionWorld* world, double padding) {
  world->setPadding(padding);
  world->setCarriedPadding(padding);
}

/// The largest of padding, padding / 2, ... near_padding that the joints are free with; below 0: none.
double freePadding(CollisionWorld* world, const JointVector& joints, const PlanningOptions& options) {
  for (double padding = options.padding;; padding = std::max(options.near_padding, padding / 2)) {
    pad(world, padding);
    if (world->valid(joints)) return padding;
    if (padding <= options.near_padding) return -1;
  }
}

bool lineFree(const PathTest& test, const std::vector<JointVector>& points) {
  int tests = 0;
  for (size_t i = 0; i + 1 < points.size(); ++i)
    if (!edgeFree(test, points[i], points[i + 1], 0.01, true, &tests)) return false;
  return true;
}

/// What meets at the beginning of a way parts on it, once and for all. How deep it meets tells nothing: that
/// is not known of meshes. The shortest way out is tried first.
bool parts(const CollisionWorld& bare, const std::vector<JointVector>& way) {
  bool parted = false;
  for (size_t i = 0; i + 1 < way.size(); ++i)
    for (int k = 1; k <= kPartingSteps; ++k) {
      const bool meets =
          !bare.firstCollision(way[i] + (way[i + 1] - way[i]) * k / kPartingSteps).first.empty();
      if (parted && meets) return false;
      parted = !meets;
    }
  return parted;
}

std::vector<JointVector> straightWay(const ToolArm& arm, const JointVector& start,
                                     const Eigen::Vector3d& motion, const PlanningOptions& options) {
  Rigid3 goal = arm.baseFromTcp(start);
  goal.translation += motion;
  const CartesianPath line = cartesianPath(arm, start, goal, options.cartesian);
  return line.found() ? line.points : std::vector<JointVector>();
}

Departure along(const ToolArm& arm, const std::vector<JointVector>& way, const PathTest& test, double padding,
                const PlanningOptions& options) {
  TimingOptions slow = options.timing;
  slow.tool_speed = std::min(options.near_speed, slow.tool_speed);
  Departure departure;
  departure.possible = true;
  departure.trajectory = timeParameterise(arm, way, test, slow);
  departure.end = way.back();
  departure.padding = padding;
  return departure;
}

void requireStart(const ToolArm& arm, const JointVector& start) {
  if (!start.allFinite()) throw BadInput("the start joints are not finite");
  if (!arm.arm.withinLimits(start)) throw BadInput("the start joints are outside their limits");
}

CollisionWorld trueShapes(const CollisionWorld& world, const TouchingPairs& touching) {
  CollisionWorld bare = world;
  pad(&bare, 0);
  for (const auto& pair : touching) bare.allow(pair.first, pair.second);
  return bare;
}

PathTest testOfTrueShapes(const CollisionWorld& bare) {
  PathTest test = testIn(bare);
  test.padding = kStep / 2;
  return test;
}

template <class Lengths>
std::vector<std::vector<JointVector>> waysOut(const ToolArm& arm, const JointVector& start,
                                              const Lengths& lengths, const PlanningOptions& options) {
  std::vector<std::vector<JointVector>> ways;
  const Rigid3 tcp = arm.baseFromTcp(start);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), x = Eigen::Vector3d::UnitX(),
                        y = Eigen::Vector3d::UnitY(), back = -tcp.rotation.col(2);

  for (double length : lengths)
    for (const Eigen::Vector3d& direction : {up, back, x, Eigen::Vector3d(-x), y, Eigen::Vector3d(-y)}) {
      std::vector<JointVector> way = straightWay(arm, start, length * direction, options);
      if (!way.empty()) ways.push_back(std::move(way));
    }

  for (double turn : kTurns)
    for (int joint = 0; joint < 6; ++joint)
      for (double sign : {1.0, -1.0}) {
        JointVector end = start;
        end[joint] += sign * turn;
        if (arm.arm.withinLimits(end)) ways.push_back({start, end});
      }
  return ways;
}

}  // namespace

Departure planDeparture(const ToolArm& arm, const CollisionWorld& world, const JointVector& start,
                        const TouchingPairs& touching, const PlanningOptions& options) {
  options.check();
  requireStart(arm, start);
  Departure departure;
  departure.end = start;
  CollisionWorld padded = world;
  departure.padding = freePadding(&padded, start, options);
  if (departure.padding >= 0) {
    departure.possible = true;
    return departure;
  }

  const CollisionWorld bare = trueShapes(world, touching);
  if (!bare.valid(start)) {
    departure.reason = "start: " + describe(bare.firstCollision(start));
    return departure;
  }
  const PathTest test = testOfTrueShapes(bare);
  for (const std::vector<JointVector>& way : waysOut(arm, start, kLengths, options)) {
    const double padding = freePadding(&padded, way.back(), options);
    if (padding < 0 || !lineFree(test, way)) continue;
    return along(arm, way, test, padding, options);
  }
  pad(&padded, options.near_padding);
  departure.reason = "start: " + describe(padded.firstCollision(start)) + ", and no way leads away from it";
  return departure;
}

Departure planRecovery(const ToolArm& arm, const CollisionWorld& world, const JointVector& start,
                       const TouchingPairs& touching, const PlanningOptions& options) {
  Departure departure = planDeparture(arm, world, start, touching, options);
  if (departure.possible) return departure;

  const CollisionWorld bare = trueShapes(world, touching);
  CollisionWorld parting = bare;
  for (int k = 0; k < kMaxMet; ++k) {
    const CollisionPair met = parting.firstCollision(start);
    if (met.first.empty()) break;
    parting.allow(met.first, met.second);
  }

  const PathTest test = testOfTrueShapes(parting);
  CollisionWorld padded = world;
  for (const std::vector<JointVector>& way : waysOut(arm, start, kRecoveries, options)) {
    const double padding = freePadding(&padded, way.back(), options);
    if (padding < 0 || !lineFree(test, way) || !parts(bare, way)) continue;
    return along(arm, way, test, padding, options);
  }
  departure.reason += ", and no straight way out of it is free";
  return departure;
}

std::vector<Departure> planWithdrawals(const ToolArm& arm, const CollisionWorld& world,
                                       const JointVector& start, const TouchingPairs& touching,
                                       const PlanningOptions& options) {
  options.check();
  requireStart(arm, start);

  const CollisionWorld bare = trueShapes(world, touching);
  const PathTest test = testOfTrueShapes(bare);
  CollisionWorld padded = world;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), back = -arm.baseFromTcp(start).rotation.col(2);

  std::vector<Departure> withdrawals;
  for (const Eigen::Vector3d& direction : {up, back})
    for (double length : kWithdrawals) {
      const std::vector<JointVector> way = straightWay(arm, start, length * direction, options);
      if (way.empty() || !bare.valid(start)) continue;
      const double padding = freePadding(&padded, way.back(), options);
      if (padding < 0 || !lineFree(test, way)) continue;
      withdrawals.push_back(along(arm, way, test, padding, options));
      break;
    }
  return withdrawals;
}

}  // namespace monocular_eye_hand
