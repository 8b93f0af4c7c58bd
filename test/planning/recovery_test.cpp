// Ways out for an arm whose true shapes meet something.
#include <gtest/gtest.h>

#include "monocular_eye_hand/planning/move_planner.h"
#include "scene.h"

namespace monocular_eye_hand {
namespace {

JointVector jointsAt(const Rigid3& base_from_tcp) {
  ArmSolutions solutions;
  toolArm().inverse(base_from_tcp, lookingJoints(), &solutions);
  for (const ArmSolution& s : solutions)
    if (s.configuration == ArmConfiguration{Shoulder::kRight, Elbow::kUp, Wrist::kPositive}) return s.joints;
  return solutions[0].joints;
}

CollisionWorld emptyTable() {
  CollisionWorld world(armDescription());
  world.addBox("table", {0.70, 1.50, 0.04}, at(0.60, -0.15, kTableTop - 0.02));
  return world;
}

void expectWayOut(const CollisionWorld& world, const JointVector& start) {
  const Departure departure = planRecovery(toolArm(), world, start, {});
  ASSERT_TRUE(departure.possible) << departure.reason;
  ASSERT_GE(departure.trajectory.points.size(), 2u);
  EXPECT_EQ(departure.trajectory.points.front().position, start);
  CollisionWorld bare = world;
  bare.setPadding(0);
  EXPECT_TRUE(bare.valid(departure.end)) << bare.firstCollision(departure.end).second;
}

TEST(Recovery, FreeArmsNeedNoWay) {
  const Departure departure = planRecovery(toolArm(), demoWorld(), lookingJoints(), {});
  EXPECT_TRUE(departure.possible);
  EXPECT_TRUE(departure.trajectory.points.empty());
}

TEST(Recovery, OutOfTheTable) {
  const CollisionWorld world = emptyTable();
  const JointVector start =
      jointsAt(down(0.5, -0.3, kTableTop + 0.005));  // the fingers' ends lie below the top
  EXPECT_FALSE(planDeparture(toolArm(), world, start, {}).possible);
  expectWayOut(world, start);
}

TEST(Recovery, OutOfAnObjectThatIsKnownWrongly) {
  CollisionWorld world = emptyTable();
  world.addMesh("bridge 3", shippedMesh("bridge"), at(0.5, -0.28, kTableTop + 1e-4));
  const JointVector start = jointsAt(down(0.5, -0.3, kTableTop + 0.03));
  EXPECT_FALSE(planDeparture(toolArm(), world, start, {}).possible);
  expectWayOut(world, start);
}

TEST(Recovery, NotThroughWhatStandsAbove) {
  CollisionWorld world = emptyTable();
  world.addBox("lid", {1.0, 1.0, 0.02},
               at(0.5, -0.3, kTableTop + 0.12));  // around the hand: it meets that, too
  const JointVector start = jointsAt(down(0.5, -0.3, kTableTop + 0.005));
  const Departure departure = planRecovery(toolArm(), world, start, {});
  EXPECT_FALSE(departure.possible);
  EXPECT_NE(departure.reason.find("no straight way out of it is free"), std::string::npos)
      << departure.reason;
}

}  // namespace
}  // namespace monocular_eye_hand
