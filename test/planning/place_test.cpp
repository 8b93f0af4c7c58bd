#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/planning/move_planner.h"
#include "scene.h"

namespace monocular_eye_hand {
namespace {

/// Holding the first bridge `lift` above where it stood.
PlaceRequest placeRequest(double lift) {
  const PickRequest pick = bridgeRequest();
  PlaceRequest request;
  Rigid3 tcp = pick.target.base_from_grasp;
  request.object = pick.target.object;
  request.tcp_from_object = tcp.inverse() * demoWorld().pose(request.object);
  tcp.translation.z() += lift;
  ArmSolutions solutions;
  toolArm().inverse(tcp, pick.start, &solutions);
  for (const ArmSolution& s : solutions)
    if (s.configuration == toolArm().arm.configuration(pick.start)) request.start = s.joints;
  request.opening = pick.target.opening;
  request.part_width = pick.target.part_width;
  request.drops = pick.drops;
  request.supports = pick.supports;
  return request;
}

TEST(Place, FromTheLift) {
  const CollisionWorld world = demoWorld();
  const PlaceRequest request = placeRequest(0.1);
  const PickPlan plan = planPlace(toolArm(), world, request);
  ASSERT_TRUE(plan.planned()) << toString(plan.outcome) << ": " << plan.reason;
  ASSERT_EQ(plan.motions.size(), 3u);
  EXPECT_EQ(plan.motions[0].stage, PickStage::kCarry);
  EXPECT_EQ(plan.motions[2].stage, PickStage::kRetreat);
  const Trajectory& carry = plan.motion(PickStage::kCarry).trajectory;
  EXPECT_EQ(carry.points.front().position, request.start);
  CollisionWorld held = world;
  held.setGripperWidth(request.part_width);
  held.attach(request.object, request.tcp_from_object);
  EXPECT_EQ(firstCollision(held, carry, PathOptions().resolution / 10).second, "");
  const Rigid3 end = toolArm().baseFromTcp(plan.motion(PickStage::kLower).trajectory.points.back().position);
  EXPECT_LT((end.translation - request.drops[size_t(plan.drop)].base_from_tcp.translation).norm(), 1e-9);
}

TEST(Place, LiftsFirstWhatStandsOnTheTable) {
  const CollisionWorld world = demoWorld();
  const PlaceRequest request = placeRequest(0);  // stopped before the lift
  const PickPlan plan = planPlace(toolArm(), world, request);
  ASSERT_TRUE(plan.planned()) << toString(plan.outcome) << ": " << plan.reason;
  ASSERT_EQ(plan.motions.size(), 4u);
  EXPECT_EQ(plan.motions[0].stage, PickStage::kLift);
  const JointVector lifted = plan.motion(PickStage::kLift).trajectory.points.back().position;
  EXPECT_LT((plan.motion(PickStage::kCarry).trajectory.points.front().position - lifted).norm(), 1e-9);
  PlaceRequest unsupported = request;
  unsupported.supports.clear();
  CollisionWorld sunk = world;
  sunk.move("table", at(0.60, -0.15, kTableTop - 0.02 + 1e-3));
  EXPECT_EQ(planPlace(toolArm(), sunk, unsupported).outcome, PickOutcome::kStartInCollision);
}

TEST(Place, WithdrawsFromANarrowPlace) {
  // Just lifted, between posts as high as the arch: only up leads out, and no search finds that.
  CollisionWorld world = demoWorld();
  for (double x : {-0.075, 0.075})
    for (double y : {-0.035, 0.035})
      world.addBox("post " + std::to_string(x) + std::to_string(y), {0.02, 0.02, 0.05},
                   at(0.50 + x, 0.045 + y, kTableTop + 0.025));
  world.remove("bridge_1");
  PlanningOptions options;
  options.path.budget = 4000;
  const PlaceRequest request = placeRequest(0.008);
  const PickPlan plan = planPlace(toolArm(), world, request, options);
  ASSERT_TRUE(plan.planned()) << toString(plan.outcome) << ": " << plan.reason;
  ASSERT_EQ(plan.motions.size(), 4u);
  EXPECT_EQ(plan.motions[0].stage, PickStage::kLift);

  CollisionWorld held = world;
  held.setGripperWidth(request.part_width);
  held.attach(request.object, request.tcp_from_object);
  for (const PickStage stage : {PickStage::kLift, PickStage::kCarry})
    EXPECT_EQ(firstCollision(held, plan.motion(stage).trajectory, PathOptions().resolution / 10).second, "");
  const Eigen::Vector3d up =
      toolArm().baseFromTcp(plan.motion(PickStage::kLift).trajectory.points.back().position).translation -
      toolArm().baseFromTcp(request.start).translation;
  EXPECT_LT((up - Eigen::Vector3d(0, 0, 0.1)).norm(), 1e-6);
}

TEST(Place, SaysWhatIsInTheWay) {
  CollisionWorld full = demoWorld();
  full.addBox("crate", {0.3, 0.3, 0.2}, at(0.5, -0.48, kTableTop + 0.1));
  const PickPlan plan = planPlace(toolArm(), full, placeRequest(0.1));
  EXPECT_TRUE(plan.outcome == PickOutcome::kDropInCollision || plan.outcome == PickOutcome::kLoweringBlocked);
  EXPECT_NE(plan.reason.find("crate"), std::string::npos) << plan.reason;
  PlaceRequest far = placeRequest(0.1);
  far.drops = {{down(1.5, 0, 0.5), down(1.5, 0, 0.4)}};
  EXPECT_EQ(planPlace(toolArm(), demoWorld(), far).outcome, PickOutcome::kDropUnreachable);
}

TEST(Place, RefusesBadInput) {
  const auto refused = [](auto change) {
    PlaceRequest request = placeRequest(0.1);
    change(request);
    EXPECT_THROW(planPlace(toolArm(), demoWorld(), request), BadInput);
  };
  refused([](PlaceRequest& r) { r.object = "nothing"; });
  refused([](PlaceRequest& r) { r.drops.clear(); });
  refused([](PlaceRequest& r) { r.supports = {"cloud"}; });
  refused([](PlaceRequest& r) { r.start[2] = NAN; });
  refused([](PlaceRequest& r) { r.tcp_from_object.translation.x() = NAN; });
  refused([](PlaceRequest& r) { r.part_width = -1; });
}

}  // namespace
}  // namespace monocular_eye_hand
