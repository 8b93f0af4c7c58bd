#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "scene.h"

namespace monocular_eye_hand {
namespace {

const std::array<JointLimit, 6>& limits() {
  static const Puma560 arm;
  return arm.options().joints;
}
JointVector over(double x, double y, double z) {
  const JointVector near = lookingJoints();
  ArmSolutions solutions;
  toolArm().inverse(down(x, y, z), near, &solutions);
  if (solutions.empty()) throw BadInput("not in reach");
  JointVector best = solutions[0].joints;
  for (const ArmSolution& s : solutions)
    if ((s.joints - near).norm() < (best - near).norm()) best = s.joints;
  return best;
}
/// From one side of a wall to the other.
struct Walled {
  CollisionWorld world = demoWorld();
  JointVector start = over(0.5, 0.25, 0.42), goal = over(0.5, -0.25, 0.42);
  Walled() {
    world.addBox("wall", {0.4, 0.02, 0.3}, at(0.55, 0.0, kTableTop + 0.15));
    world.setPadding(0.003);
  }
};

TEST(PlanPath, StraightWhereFree) {
  const CollisionWorld world = demoWorld();
  const JointVector a = over(0.5, 0.2, 0.6), b = over(0.5, -0.2, 0.6);
  const JointPath path = planPath(limits(), a, {b}, testIn(world));
  ASSERT_TRUE(path.found());
  ASSERT_EQ(path.points.size(), 2u);
  EXPECT_EQ(path.points[0], a);
  EXPECT_EQ(path.points[1], b);
}

TEST(PlanPath, AroundAWallFreeAtTenTimesTheResolution) {
  Walled w;
  for (int seed = 1; seed <= 10; ++seed) {
    PathOptions options;
    options.seed = seed;
    w.world.setPadding(0.003);
    const JointPath path = planPath(limits(), w.start, {w.goal}, testIn(w.world), options);
    ASSERT_TRUE(path.found());
    EXPECT_GT(path.points.size(), 2u) << "the straight edge crosses the wall";
    EXPECT_EQ(path.points.front(), w.start);
    EXPECT_EQ(path.points.back(), w.goal);
    w.world.setPadding(0);
    for (size_t i = 0; i + 1 < path.points.size(); ++i) {
      int tests = 0;
      EXPECT_TRUE(edgeFree(testIn(w.world), path.points[i], path.points[i + 1], options.resolution / 10,
                           false, &tests));
    }
  }
}

TEST(PlanPath, SameCallSamePathInAnyOrder) {
  Walled w;
  const PathTest test = testIn(w.world);
  const JointVector other = over(0.45, -0.3, 0.5);
  const JointPath a1 = planPath(limits(), w.start, {w.goal}, test),
                  b1 = planPath(limits(), w.start, {other}, test);
  const JointPath b2 = planPath(limits(), w.start, {other}, test),
                  a2 = planPath(limits(), w.start, {w.goal}, test);
  ASSERT_TRUE(a1.found());
  ASSERT_TRUE(b1.found());
  EXPECT_GT(a1.points.size(), 2u);
  EXPECT_EQ(a1.points, a2.points);
  EXPECT_EQ(b1.points, b2.points);
  EXPECT_EQ(a1.tests, a2.tests);
  PathOptions seeded;
  seeded.seed = 99;
  EXPECT_NE(planPath(limits(), w.start, {w.goal}, test, seeded).points, a1.points) << "the seed is used";
}

TEST(PlanPath, ReasonsInsteadOfPaths) {
  Walled w;
  const PathTest test = testIn(w.world);
  const JointVector in_table = over(0.5, 0.25, kTableTop - 0.02);
  EXPECT_EQ(planPath(limits(), in_table, {w.goal}, test).outcome, PathOutcome::kStartInCollision);
  EXPECT_EQ(planPath(limits(), w.start, {in_table}, test).outcome, PathOutcome::kGoalInCollision);
  JointVector beyond = w.goal;
  beyond[4] = 2;
  EXPECT_EQ(planPath(limits(), w.start, {beyond}, test).outcome, PathOutcome::kOutsideLimits);
  const JointPath second = planPath(limits(), w.start, {in_table, w.goal}, test);
  ASSERT_TRUE(second.found());
  EXPECT_EQ(second.goal, 1);
  PathOptions little;
  little.budget = 20;
  const JointPath none = planPath(limits(), w.start, {w.goal}, test, little);
  EXPECT_EQ(none.outcome, PathOutcome::kNoPath);
  EXPECT_LT(none.tests, 200) << "the budget ends the search";
}

TEST(PlanPath, FindsThinThingsThatCoarseStepsMiss) {
  Walled w;
  w.world.remove("wall");
  w.world.addBox("blade", {0.4, 0.0005, 0.3}, at(0.55, 0.0, kTableTop + 0.15));
  PathOptions coarse;
  coarse.resolution = 0.3;
  const JointPath path = planPath(limits(), w.start, {w.goal}, testIn(w.world), coarse);
  ASSERT_TRUE(path.found());
  w.world.setPadding(0);
  for (size_t i = 0; i + 1 < path.points.size(); ++i) {
    int tests = 0;
    EXPECT_TRUE(edgeFree(testIn(w.world), path.points[i], path.points[i + 1], 3e-4, false, &tests));
  }
}

TEST(PlanPath, RefusesBadInput) {
  const CollisionWorld world = demoWorld();
  const JointVector q = lookingJoints();
  EXPECT_THROW(planPath(limits(), JointVector::Constant(NAN), {q}, testIn(world)), BadInput);
  EXPECT_THROW(planPath(limits(), q, {JointVector::Constant(NAN)}, testIn(world)), BadInput);
  EXPECT_THROW(planPath(limits(), q, {}, testIn(world)), BadInput);
  EXPECT_THROW(planPath(limits(), q, {q}, PathTest()), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
