#include "monocular_eye_hand/planning/move_planner.h"

#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "scene.h"

namespace monocular_eye_hand {
namespace {

MoveRequest moveTo(std::vector<Rigid3> poses) {
  MoveRequest request;
  request.start = lookingJoints();
  request.base_from_tcp = std::move(poses);
  return request;
}

void expectFree(const CollisionWorld& world, const MovePlan& plan) {
  CollisionWorld bare = world;
  bare.setPadding(0);
  for (const Trajectory& motion : plan.motions)
    EXPECT_EQ(firstCollision(bare, motion, PathOptions().resolution / 10).second, "");
}

JointVector endOf(const MovePlan& plan) { return plan.motions.back().points.back().position; }

TEST(Move, TakesTheFirstPoseThatCanBeReached) {
  const CollisionWorld world = demoWorld();
  const MoveRequest request =
      moveTo({down(1.5, 0, 0.6), down(0.5, 0, kTableTop - 0.01), down(0.4, -0.3, 0.6), down(0.5, 0.2, 0.6)});
  const MovePlan plan = planMove(toolArm(), world, request);
  ASSERT_TRUE(plan.planned()) << toString(plan.outcome) << ": " << plan.reason;
  EXPECT_EQ(plan.goal, 2);
  EXPECT_EQ(plan.motions.front().points.front().position, request.start);
  EXPECT_LT((toolArm().baseFromTcp(endOf(plan)).translation - Eigen::Vector3d(0.4, -0.3, 0.6)).norm(), 1e-9);
  expectFree(world, plan);
}

TEST(Move, ToJointAngles) {
  const CollisionWorld world = demoWorld();
  MoveRequest request;
  request.start = lookingJoints();
  JointVector up = JointVector::Zero();
  up[1] = M_PI / 2;
  up[2] = -M_PI / 2;
  request.joints = {up};
  const MovePlan plan = planMove(toolArm(), world, request);
  ASSERT_TRUE(plan.planned()) << plan.reason;
  EXPECT_EQ(endOf(plan), up);
  request.start = up;
  const MovePlan nothing = planMove(toolArm(), world, request);
  EXPECT_TRUE(nothing.planned());
  EXPECT_TRUE(nothing.motions.empty());
}

TEST(Move, SaysWhyNot) {
  MovePlan plan = planMove(toolArm(), demoWorld(), moveTo({down(1.5, 0, 0.6)}));
  EXPECT_EQ(plan.outcome, MoveOutcome::kUnreachable) << plan.reason;
  EXPECT_TRUE(plan.motions.empty());
  plan = planMove(toolArm(), demoWorld(), moveTo({down(1.5, 0, 0.6), down(0.5, 0, kTableTop - 0.01)}));
  EXPECT_EQ(plan.outcome, MoveOutcome::kGoalInCollision);
  EXPECT_NE(plan.reason.find("table"), std::string::npos) << plan.reason;

  // Behind a wall, in the same configuration: there is a way around, but not within two tests.
  CollisionWorld wall = demoWorld();
  wall.addBox("wall", {0.50, 0.01, 0.45}, at(0.60, -0.25, kTableTop + 0.225));
  MoveRequest behind;
  behind.start = lookingJoints();
  ArmSolutions solutions;
  toolArm().inverse(down(0.5, -0.45, 0.4), behind.start, &solutions);
  for (const ArmSolution& s : solutions)
    if (s.configuration == toolArm().arm.configuration(behind.start) && behind.joints.empty())
      behind.joints.push_back(s.joints);
  ASSERT_EQ(behind.joints.size(), 1u);
  EXPECT_TRUE(planMove(toolArm(), wall, behind).planned());
  PlanningOptions options;
  options.path.budget = 8;
  plan = planMove(toolArm(), wall, behind, options);
  EXPECT_EQ(plan.outcome, MoveOutcome::kNoPath) << plan.reason;
  EXPECT_NE(plan.reason.find("budget 2"), std::string::npos) << plan.reason;
}

TEST(Move, LeavesWhatItNearlyTouches) {
  CollisionWorld world = demoWorld();
  MoveRequest request = moveTo({down(0.4, 0.2, 0.62)});
  request.start = cartesianPath(toolArm(), request.start, down(0.45, -0.2, 0.62)).points.back();
  const double tip = toolArm().baseFromTcp(request.start).translation.z() - 0.009;
  // 0.1 mm under the fingers' ends: nearer than any padding.
  world.addBox("shelf", {0.1, 0.1, 0.01}, at(0.45, -0.2, tip - 1e-4 - 0.005));
  world.setPadding(PlanningOptions().near_padding);
  ASSERT_FALSE(world.valid(request.start));
  world.setPadding(0);
  ASSERT_TRUE(world.valid(request.start));
  const MovePlan plan = planMove(toolArm(), world, request);
  ASSERT_TRUE(plan.planned()) << toString(plan.outcome) << ": " << plan.reason;
  EXPECT_EQ(plan.motions.size(), 2u);
  EXPECT_LT((plan.motions[0].points.back().position - plan.motions[1].points.front().position).norm(), 1e-9);
  expectFree(world, plan);
}

TEST(Move, WhatTouchesKeepsItUnlessAllowed) {
  CollisionWorld world = demoWorld();
  MoveRequest request = moveTo({down(0.4, 0.2, 0.62)});
  const Rigid3 tcp = toolArm().baseFromTcp(request.start);
  world.addBox("part", {0.02, 0.05, 0.02}, tcp);
  world.setGripperWidth(0.045);  // the pads reach into it
  MovePlan plan = planMove(toolArm(), world, request);
  EXPECT_EQ(plan.outcome, MoveOutcome::kStartInCollision);
  EXPECT_NE(plan.reason.find("part"), std::string::npos) << plan.reason;
  EXPECT_TRUE(plan.motions.empty());
  for (const std::string& finger : world.fingers()) request.touching.emplace_back(finger, "part");
  plan = planMove(toolArm(), world, request);
  EXPECT_TRUE(plan.planned()) << plan.reason;
}

TEST(Move, RefusesBadInput) {
  const CollisionWorld world = demoWorld();
  EXPECT_THROW(planMove(toolArm(), world, moveTo({})), BadInput);
  MoveRequest both = moveTo({down(0.4, 0, 0.6)});
  both.joints = {lookingJoints()};
  EXPECT_THROW(planMove(toolArm(), world, both), BadInput);
  EXPECT_THROW(planMove(toolArm(), world, moveTo({down(NAN, 0, 0.6)})), BadInput);
  MoveRequest start = moveTo({down(0.4, 0, 0.6)});
  start.start[0] = 3;
  EXPECT_THROW(planMove(toolArm(), world, start), BadInput);
}

TEST(Move, OutcomesAreThoseOfTheAction) {
  EXPECT_EQ(outcomeOf(MoveOutcome::kPlanned), ActionOutcome::kDone);
  for (const MoveOutcome met : {MoveOutcome::kStartInCollision, MoveOutcome::kGoalInCollision})
    EXPECT_EQ(outcomeOf(met), ActionOutcome::kInCollision) << toString(met);
  for (const MoveOutcome far : {MoveOutcome::kUnreachable, MoveOutcome::kNoPath})
    EXPECT_EQ(outcomeOf(far), ActionOutcome::kUnreachable) << toString(far);
}

}  // namespace
}  // namespace monocular_eye_hand
