#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "monocular_eye_hand/geometry/error.h"
#include "scene.h"

namespace monocular_eye_hand {
namespace {

JointVector straightOver(double x, double y, double z) {
  const CartesianPath path = cartesianPath(toolArm(), lookingJoints(), down(x, y, z));
  EXPECT_TRUE(path.found()) << path.reason;
  return path.points.back();
}

TEST(CollisionWorld, FreeAndTouchingWithNames) {
  CollisionWorld world = demoWorld();
  world.setGripperWidth(0.06);
  EXPECT_TRUE(world.valid(lookingJoints()));
  EXPECT_EQ(world.firstCollision(lookingJoints()).first, "");
  const JointVector low =
      straightOver(0.38, 0.2, kTableTop + 0.004);  // the fingers end 9 mm below gripper_tcp
  EXPECT_FALSE(world.valid(low));
  const CollisionPair pair = world.firstCollision(low);
  EXPECT_EQ(pair.first.substr(0, 6), "finger");
  EXPECT_EQ(pair.second, "table");
  EXPECT_NEAR(pair.distance, -0.005, 1e-4);
}

TEST(CollisionWorld, ClearanceIsTheDistance) {
  CollisionWorld world = demoWorld();
  world.setGripperWidth(0.02);
  const JointVector above = straightOver(0.36, 0.25, kTableTop + 0.009 + 0.012);
  const CollisionPair pair = world.clearance(above, 0.05);
  EXPECT_EQ(pair.second, "table");
  EXPECT_NEAR(pair.distance, 0.012, 1e-4);
  EXPECT_EQ(world.clearance(above, 0.005).first, "");
}

TEST(CollisionWorld, PaddingIsADistance) {
  CollisionWorld world = demoWorld();
  const JointVector above = straightOver(0.36, 0.25, kTableTop + 0.009 + 0.004);
  EXPECT_TRUE(world.valid(above));
  world.setPadding(0.0039);
  EXPECT_TRUE(world.valid(above));
  world.setPadding(0.0041);
  EXPECT_FALSE(world.valid(above));
  EXPECT_NEAR(world.firstCollision(above).distance, 0.004, 1e-4);
}

TEST(CollisionWorld, TheFrameIsConcaveAndSolid) {
  CollisionWorld world(armDescription());
  world.addMesh("frame", shippedMesh("frame"), at(0.55, 0, kTableTop));
  EXPECT_TRUE(world.valid(straightOver(0.55, 0, kTableTop + 0.012))) << "in the opening";
  EXPECT_FALSE(world.valid(straightOver(0.55, 0.095, kTableTop + 0.02))) << "on the bar";
  // A small solid wholly inside a closed one touches no surface of it.
  CollisionWorld inside(armDescription());
  Mesh block = shippedMesh("frame");
  for (Eigen::Vector3d& p : block.vertices) p *= 20;
  const Rigid3 tcp = toolArm().baseFromTcp(lookingJoints());
  Rigid3 pose = tcp;
  pose.translation -= Eigen::Vector3d(0, 0.095 * 20, 0.0125 * 20);
  pose.rotation.setIdentity();
  inside.addMesh("block", block, pose);
  EXPECT_EQ(inside.firstCollision(lookingJoints()).second, "block");
}

TEST(CollisionWorld, CarriedObjectCollidesAndMayRestOnTheTable) {
  CollisionWorld world = demoWorld();
  world.setGripperWidth(0.04);
  const JointVector grasp = straightOver(0.50, 0.045, kTableTop + 0.048);
  EXPECT_TRUE(world.valid(straightOver(0.50, 0.045, kTableTop + 0.15)));
  world.attach("bridge_0",
               down(0.50, 0.045, kTableTop + 0.048).inverse() * at(0.50, 0.045, kTableTop - 1e-4));
  EXPECT_EQ(world.carried(), "bridge_0");
  CollisionPair pair = world.firstCollision(grasp);
  EXPECT_EQ(pair.first, "bridge_0");
  EXPECT_EQ(pair.second, "table");

  world.allow("bridge_0", "table");
  EXPECT_TRUE(world.allowed("table", "bridge_0"));
  EXPECT_TRUE(world.valid(grasp));
  pair = world.firstCollision(straightOver(0.50, 0.10, kTableTop + 0.060));
  EXPECT_EQ(pair.first, "bridge_0");
  EXPECT_EQ(pair.second, "frame");
  world.forbid("bridge_0", "table");
  world.setCarriedPadding(0.01);
  EXPECT_FALSE(world.valid(straightOver(0.36, 0.3, kTableTop + 0.048 + 0.009)));
  EXPECT_TRUE(world.valid(straightOver(0.36, 0.3, kTableTop + 0.048 + 0.011)));
  world.detach(at(0.4, -0.4, kTableTop));
  EXPECT_EQ(world.carried(), "");
  EXPECT_EQ(world.pose("bridge_0").translation.y(), -0.4);
}

TEST(CollisionWorld, TheArmAgainstItself) {
  const CollisionWorld world(armDescription());
  EXPECT_TRUE(world.valid(JointVector::Zero()));
  JointVector folded = lookingJoints();
  bool touched = false;
  for (double q3 = -M_PI; q3 < 0.7;
       q3 += 0.02) {  // the forearm folds back over the upper arm and the pedestal
    folded[1] = -0.7;
    folded[2] = q3;
    const CollisionPair pair = world.firstCollision(folded);
    if (pair.first.empty()) continue;
    touched = true;
    const auto names = armDescription().links;
    EXPECT_TRUE(
        std::any_of(names.begin(), names.end(), [&](const ArmLink& l) { return l.name == pair.second; }));
  }
  EXPECT_TRUE(touched);
}

TEST(CollisionWorld, MotionBoundHolds) {
  CollisionWorld world = demoWorld();
  world.attach("bridge_0", at(0.0, 0.0, 0.05));
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(-2, 2), small(-0.05, 0.05);
  const Eigen::Vector3d corner(0.06, 0.02, 0.11);  // of the bridge, in gripper_tcp
  for (int n = 0; n < 500; ++n) {
    JointVector q, delta;
    for (int i = 0; i < 6; ++i) {
      q[i] = angle(random);
      delta[i] = small(random);
    }
    const double moved =
        (toolArm().baseFromTcp(q) * corner - toolArm().baseFromTcp(q + delta) * corner).norm();
    EXPECT_LE(moved, world.motionBound(delta));
  }
}

TEST(CollisionWorld, CopiesAreIndependentAndRemovalKeepsTheRest) {
  CollisionWorld world = demoWorld();
  CollisionWorld copy = world;
  copy.remove("frame");
  copy.allow("bridge_1", "table");
  copy.remove("bridge_0");
  EXPECT_TRUE(copy.allowed("table", "bridge_1"));
  EXPECT_FALSE(copy.allowed("table", "grenade"));
  EXPECT_TRUE(world.has("frame"));
  EXPECT_EQ(copy.names(), (std::vector<std::string>{"table", "bridge_1", "grenade"}));
}

TEST(CollisionWorld, RefusesBadInput) {
  CollisionWorld world = demoWorld();
  EXPECT_THROW(world.addBox("table", {1, 1, 1}, {}), BadInput);
  EXPECT_THROW(world.addBox("link2", {1, 1, 1}, {}), BadInput);
  EXPECT_THROW(world.addBox("flat", {1, 1, 0}, {}), BadInput);
  EXPECT_THROW(world.addBox("nowhere", {1, 1, 1}, at(NAN, 0, 0)), BadInput);
  EXPECT_THROW(world.addMesh("empty", Mesh(), {}), BadInput);

  Mesh broken;
  broken.vertices = {{0, 0, 0}, {1, 0, 0}};
  broken.triangles = {{{0, 1, 2}}};
  EXPECT_THROW(world.addMesh("broken", broken, {}), BadInput);
  EXPECT_THROW(world.remove("link2"), BadInput);
  EXPECT_THROW(world.allow("table", "nothing"), BadInput);
  EXPECT_THROW(world.detach({}), BadInput);
  EXPECT_THROW(world.setPadding(-1), BadInput);
  EXPECT_THROW(world.setGripperWidth(NAN), BadInput);
  EXPECT_FALSE(world.valid(JointVector::Constant(NAN)));
  EXPECT_THROW(world.firstCollision(JointVector::Constant(NAN)), BadInput);
  EXPECT_FALSE(world.has("flat")) << "a refused object leaves nothing behind";
}

}  // namespace
}  // namespace monocular_eye_hand
