#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "scene.h"

namespace monocular_eye_hand {
namespace {

void expectChained(const PickPlan& plan, const JointVector& start) {
  JointVector at = start;
  ASSERT_EQ(plan.motions.size(), 6u);
  for (const PickMotion& motion : plan.motions) {
    EXPECT_LT((motion.trajectory.points.front().position - at).norm(), 1e-9) << toString(motion.stage);
    at = motion.trajectory.points.back().position;
  }
}

void expectFree(const CollisionWorld& world, const PickRequest& request, const PickPlan& plan) {
  for (const PickMotion& motion : plan.motions) {
    const CollisionPair hit = firstCollision(worldOf(motion.stage, world, request, plan), motion.trajectory,
                                             PathOptions().resolution / 10);
    EXPECT_EQ(hit.first, "") << toString(motion.stage) << ": " << hit.second << " " << hit.distance;
  }
}

TEST(Pick, CarriesEveryObjectOutOfTheFrame) {
  CollisionWorld world = demoWorld();
  for (const PickRequest& request :
       {bridgeRequest(), pickRequest("bridge_1", 0.505, -0.045, kTableTop + 0.048, 0.1, 0.040)}) {
    const PickPlan plan = planPick(toolArm(), world, request);
    ASSERT_TRUE(plan.planned()) << toString(plan.outcome) << ": " << plan.reason;
    expectChained(plan, request.start);
    expectFree(world, request, plan);
    const Rigid3 end =
        toolArm().baseFromTcp(plan.motion(PickStage::kLower).trajectory.points.back().position);
    EXPECT_LT((end.translation - request.drops[plan.drop].base_from_tcp.translation).norm(), 1e-9);
    EXPECT_LT(plan.duration(), 30);
    EXPECT_TRUE(world.carried().empty()) << "the world that was given is left alone";
  }
}

TEST(Pick, SameRequestSamePlan) {
  const CollisionWorld world = demoWorld();
  const PickPlan a = planPick(toolArm(), world, bridgeRequest());
  planPick(toolArm(), world, pickRequest("bridge_1", 0.505, -0.045, kTableTop + 0.048, 0.1, 0.040));
  const PickPlan b = planPick(toolArm(), world, bridgeRequest());
  ASSERT_TRUE(a.planned());
  ASSERT_TRUE(b.planned());
  for (size_t i = 0; i < a.motions.size(); ++i) {
    const auto &p = a.motions[i].trajectory.points, &q = b.motions[i].trajectory.points;
    ASSERT_EQ(p.size(), q.size());
    for (size_t k = 0; k < p.size(); ++k) {
      EXPECT_EQ(p[k].position, q[k].position);
      EXPECT_EQ(p[k].time_s, q[k].time_s);
    }
  }
}

TEST(Pick, SaysWhatIsOutOfReach) {
  CollisionWorld world = demoWorld();
  world.move("bridge_0", at(1.3, 0, kTableTop + 1e-4));
  const PickRequest far = pickRequest("bridge_0", 1.3, 0, kTableTop + 0.048, 0, 0.04);
  EXPECT_EQ(planPick(toolArm(), world, far).outcome, PickOutcome::kGraspUnreachable);

  PickRequest no_drop = bridgeRequest();
  no_drop.drops = {{down(1.5, 0, 0.5), down(1.5, 0, 0.4)}};
  const PickPlan plan = planPick(toolArm(), demoWorld(), no_drop);
  EXPECT_EQ(plan.outcome, PickOutcome::kDropUnreachable) << plan.reason;
}

TEST(Pick, NamesWhatBlocks) {
  CollisionWorld lid = demoWorld();
  lid.addBox("lid", {0.3, 0.3, 0.005}, at(0.5, 0.045, kTableTop + 0.095));
  PickPlan plan = planPick(toolArm(), lid, bridgeRequest());
  EXPECT_EQ(plan.outcome, PickOutcome::kApproachBlocked);
  EXPECT_NE(plan.reason.find("lid"), std::string::npos) << plan.reason;

  CollisionWorld high = demoWorld();  // something stands where the gripper waits above the bridge
  high.addBox("pillar", {0.02, 0.02, 0.1}, at(0.5, 0.045, kTableTop + 0.15));
  plan = planPick(toolArm(), high, bridgeRequest());
  EXPECT_EQ(plan.outcome, PickOutcome::kGraspInCollision);
  EXPECT_NE(plan.reason.find("pillar"), std::string::npos) << plan.reason;

  CollisionWorld full = demoWorld();
  full.addBox("crate", {0.3, 0.3, 0.2}, at(0.5, -0.48, kTableTop + 0.1));
  plan = planPick(toolArm(), full, bridgeRequest());
  EXPECT_TRUE(plan.outcome == PickOutcome::kDropInCollision || plan.outcome == PickOutcome::kLoweringBlocked);
  EXPECT_NE(plan.reason.find("crate"), std::string::npos) << plan.reason;
}

TEST(Pick, LiftBlockedByWhatLiesOnTheObject) {
  CollisionWorld world =
      demoWorld();  // a beam through the bridge's arch: the fingers miss it, the bridge does not
  world.addBox("beam", {0.03, 0.30, 0.01}, at(0.50, 0.045, kTableTop + 0.02 + 0.005));
  const PickPlan plan = planPick(toolArm(), world, bridgeRequest());
  EXPECT_TRUE(plan.planned()) << "a beam under the arch leaves the way up free: " << plan.reason;
  world.addBox("bar", {0.004, 0.01, 0.004}, at(0.555, 0.045, kTableTop + 0.064));
  const PickPlan blocked = planPick(toolArm(), world, bridgeRequest());
  EXPECT_EQ(blocked.outcome, PickOutcome::kLiftBlocked) << blocked.reason;
  EXPECT_NE(blocked.reason.find("bar"), std::string::npos);
}

TEST(Pick, StartInCollisionNamesTheObject) {
  CollisionWorld world = demoWorld();
  const Rigid3 tcp = toolArm().baseFromTcp(bridgeRequest().start);
  world.addBox("intruder", {0.05, 0.08, 0.05}, tcp);
  const PickPlan plan = planPick(toolArm(), world, bridgeRequest());
  EXPECT_EQ(plan.outcome, PickOutcome::kStartInCollision);
  EXPECT_NE(plan.reason.find("intruder"), std::string::npos);
}

TEST(Pick, NoPathWithinTheBudget) {
  CollisionWorld world = demoWorld();  // the hand starts in a well without a lid
  for (double side : {-0.12, 0.12}) {
    world.addBox("x" + std::to_string(side), {0.01, 0.25, 0.15}, at(0.40 + side, 0.3, 0.625));
    world.addBox("y" + std::to_string(side), {0.25, 0.01, 0.15}, at(0.40, 0.3 + side, 0.625));
  }
  PickRequest request = bridgeRequest();
  request.start = cartesianPath(toolArm(), request.start, down(0.40, 0.3, 0.62)).points.back();
  PlanningOptions options;
  options.path.budget = 8;
  const PickPlan plan = planPick(toolArm(), world, request, options);
  EXPECT_EQ(plan.outcome, PickOutcome::kNoPathToGrasp) << plan.reason;
  EXPECT_NE(plan.reason.find("budget"), std::string::npos) << plan.reason;
  const PickPlan found = planPick(toolArm(), world, request);
  ASSERT_TRUE(found.planned()) << toString(found.outcome) << ": " << found.reason;
  expectFree(world, request, found);
}

TEST(Pick, AnArmNearSomethingMayLeave) {
  CollisionWorld world = demoWorld();
  PickRequest request = bridgeRequest();
  request.start = cartesianPath(toolArm(), request.start, down(0.45, -0.2, 0.62)).points.back();
  const Rigid3 tcp = toolArm().baseFromTcp(request.start);
  // 1.5 mm under the fingers' ends: nearer than the padding.
  world.addBox("shelf", {0.1, 0.1, 0.01},
               at(tcp.translation.x(), tcp.translation.y(), tcp.translation.z() - 0.0155));
  world.setPadding(PlanningOptions().padding);
  world.setGripperWidth(request.target.opening);
  ASSERT_EQ(world.firstCollision(request.start).second, "shelf");
  const PickPlan plan = planPick(toolArm(), world, request);
  EXPECT_TRUE(plan.planned()) << toString(plan.outcome) << ": " << plan.reason;
}

TEST(Pick, RefusesBadInput) {
  const CollisionWorld world = demoWorld();
  const auto refused = [&](auto change) {
    PickRequest request = bridgeRequest();
    change(request);
    EXPECT_THROW(planPick(toolArm(), world, request), BadInput);
  };
  refused([](PickRequest& r) { r.target.object = "nothing"; });
  refused([](PickRequest& r) { r.target.object = "link3"; });
  refused([](PickRequest& r) { r.supports = {"cloud"}; });
  refused([](PickRequest& r) { r.drops.clear(); });
  refused([](PickRequest& r) { r.start[2] = NAN; });
  refused([](PickRequest& r) { r.start[0] = 3.1; });
  refused([](PickRequest& r) { r.target.base_from_grasp.translation.x() = NAN; });
  refused([](PickRequest& r) { r.target.part_width = -0.1; });
  PickPlan blocked;
  blocked.outcome = PickOutcome::kLiftBlocked;
  EXPECT_THROW(worldOf(PickStage::kReach, world, bridgeRequest(), blocked), BadInput);
}

TEST(Pick, MotionsAreFoundByTheirStage) {
  PickPlan plan;
  plan.motions = {{PickStage::kLift, {}, 0.01}, {PickStage::kCarry, {}, 0.02}};
  EXPECT_EQ(plan.motion(PickStage::kLift).gripper_width, 0.01);
  EXPECT_EQ(plan.motion(PickStage::kCarry).gripper_width, 0.02);
  EXPECT_THROW(plan.motion(PickStage::kRetreat), BadInput);
}

TEST(Pick, OutcomesAreThoseOfTheAction) {
  EXPECT_EQ(outcomeOf(PickOutcome::kPlanned), ActionOutcome::kDone);
  for (const PickOutcome met :
       {PickOutcome::kStartInCollision, PickOutcome::kGraspInCollision, PickOutcome::kApproachBlocked,
        PickOutcome::kLiftBlocked, PickOutcome::kDropInCollision, PickOutcome::kLoweringBlocked})
    EXPECT_EQ(outcomeOf(met), ActionOutcome::kInCollision) << toString(met);
  for (const PickOutcome far : {PickOutcome::kGraspUnreachable, PickOutcome::kNoPathToGrasp,
                                PickOutcome::kDropUnreachable, PickOutcome::kNoPathToDrop})
    EXPECT_EQ(outcomeOf(far), ActionOutcome::kUnreachable) << toString(far);
}

}  // namespace
}  // namespace monocular_eye_hand
