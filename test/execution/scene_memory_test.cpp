#include <gtest/gtest.h>

#include <algorithm>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/execution/scene_memory.h"

namespace monocular_eye_hand {
namespace {

const std::string kSource = MONOCULAR_EYE_HAND_SOURCE_DIR;

SceneMemory makeScene() {
  ExecutorOptions options;
  options.objects = kSource + "/config/objects.yaml";
  options.boxes.resize(1);
  options.boxes[0].name = "post";
  options.boxes[0].size = {{0.1, 0.1, 0.1}};
  return SceneMemory(loadArmDescription(kSource + "/urdf/puma560.urdf"), options);
}

PlacedObject bridgeAt(int instance, double x, double y) {
  PlacedObject object{"bridge", instance, {}};
  object.base_from_object.translation = {x, y, 0.3};
  return object;
}

using Names = std::vector<std::string>;

TEST(SceneMemory, HoldsWhatIsSeen) {
  SceneMemory scene = makeScene();
  EXPECT_EQ(scene.world({}).names(), (Names{"table", "post"}));
  PlacedObject unknown = bridgeAt(0, 0.5, 0);
  unknown.name = "teapot";
  EXPECT_EQ(scene.see({bridgeAt(0, 0.5, 0), bridgeAt(1, 0.6, 0.1), unknown}), (Names{"teapot 0"}));
  EXPECT_EQ(scene.world({}).names(), (Names{"table", "post", "bridge 0", "bridge 1"}));
  scene.see({bridgeAt(1, 0.6, 0.1)});
  EXPECT_EQ(scene.world({}).names(), (Names{"table", "post", "bridge 1"}));
  EXPECT_NE(scene.names().find("grenade"), std::string::npos);
}

TEST(SceneMemory, TheSubjectStandsWhereItIsSaidToStand) {
  SceneMemory scene = makeScene();
  // The same bridge under two numbers, and another one.
  scene.see({bridgeAt(0, 0.5, 0), bridgeAt(1, 0.505, 0.002), bridgeAt(2, 0.6, 0.1)});
  const CollisionWorld world = scene.world(bridgeAt(0, 0.51, 0));
  EXPECT_EQ(world.names(), (Names{"table", "post", "bridge 0", "bridge 2"}));
  EXPECT_EQ(world.pose("bridge 0").translation.x(), 0.51);
}

TEST(SceneMemory, RemembersWhatNobodySees) {
  SceneMemory scene = makeScene();
  scene.putDown(2, bridgeAt(0, 0.4, 0.3));
  EXPECT_EQ(scene.world({}).names(), (Names{"table", "post", "bridge at place 2"}));
  scene.see({bridgeAt(5, 0.41, 0.3)});
  EXPECT_EQ(scene.world({}).names(), (Names{"table", "post", "bridge 5"})) << "seen: not twice";
  scene.see({});
  EXPECT_EQ(scene.world({}).pose("bridge at place 2").translation.x(), 0.41) << "as it was seen last";
  EXPECT_EQ(scene.labels(bridgeAt(0, 0.41, 0.3)), (Names{"bridge 0", "bridge at place 2"}));
  EXPECT_EQ(scene.world(bridgeAt(0, 0.41, 0.3)).names(), (Names{"table", "post", "bridge 0"}));
  scene.takeAway(bridgeAt(0, 0.8, 0.3));
  EXPECT_EQ(scene.remembered(), 1u) << "that was another one";
  scene.takeAway(bridgeAt(0, 0.41, 0.3));
  EXPECT_EQ(scene.remembered(), 0u);
}

TEST(SceneMemory, APlaceThatIsSaidToBeFree) {
  SceneMemory scene = makeScene();
  scene.putDown(2, bridgeAt(0, 0.4, 0.3));
  EXPECT_EQ(scene.world(bridgeAt(1, 0.5, 0), 2).names(), (Names{"table", "post", "bridge 1"}));
  EXPECT_EQ(scene.world(bridgeAt(1, 0.5, 0), 1).names(),
            (Names{"table", "post", "bridge 1", "bridge at place 2"}));
  scene.see({bridgeAt(4, 0.4, 0.3)});
  EXPECT_EQ(scene.world(bridgeAt(1, 0.5, 0), 2).names(), (Names{"table", "post", "bridge 1", "bridge 4"}))
      << "somebody sees that it is not";
}

TEST(SceneMemory, WhatTheCameraSeesInTheHandIsNoObstacle) {
  SceneMemory scene = makeScene();
  PlacedObject lifted = bridgeAt(0, 0.5, 0);
  lifted.base_from_object.translation.z() += 0.1;
  PlacedObject ghost = lifted;
  ghost.instance = 3;
  ghost.base_from_object.translation.x() += 0.01;
  scene.see({ghost, bridgeAt(1, 0.6, 0.1)});
  EXPECT_EQ(scene.world(bridgeAt(0, 0.5, 0), 0, lifted).names(),
            (Names{"table", "post", "bridge 0", "bridge 1"}));
}

}  // namespace
}  // namespace monocular_eye_hand
