#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "../mesh/shapes.h"
#include "monocular_eye_hand/model/model_base.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

std::vector<ObjectEntry> entries(const std::string& keys) {
  std::string path = testing::TempDir() + "handling_XXXXXX";
  close(mkstemp(&path[0]));
  std::ofstream(path) << "objects: [{name: a, mesh: " << shapes::shippedModel("bridge") << keys << "}]\n";
  struct Remove {
    const std::string& path;
    ~Remove() { std::remove(path.c_str()); }
  } remove{path};
  return readObjectEntries(path);
}

std::string refusalOf(const std::string& keys) {
  return refusal([&] { entries(keys); });
}

TEST(Handling, DefaultsToSampledGrasps) {
  const Handling h = entries("").at(0).handling;
  EXPECT_TRUE(h.grasp);
  EXPECT_FALSE(h.obstacle);
  EXPECT_TRUE(h.grasps.empty());
}

TEST(Handling, GivenGraspsAreRead) {
  const Handling h =
      entries(
          ", grasps: [{xyz: [0, 0, 0.05], rpy: [3.14159265358979, 0, 0], width: 0.04},"
          " {xyz: [0.1, 0, 0], width: 0.02, rotation_steps: 6, axis: [0, 0, 2], point: [0.1, 0, 0]}]")
          .at(0)
          .handling;
  ASSERT_EQ(h.grasps.size(), 2u);
  EXPECT_LT((h.grasps[0].object_from_tcp.rotation.col(2) + Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_EQ(h.grasps[0].object_from_tcp.translation.z(), 0.05);
  EXPECT_EQ(h.grasps[0].width, 0.04);
  EXPECT_EQ(h.grasps[0].rotation_steps, 1);
  EXPECT_EQ(h.grasps[1].rotation_steps, 6);
  EXPECT_EQ(h.grasps[1].axis.direction, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(h.grasps[1].axis.point.x(), 0.1);
}

TEST(Handling, AnObstacleIsNeverGrasped) {
  for (const char* yes : {"true", "Yes", "on"})
    EXPECT_FALSE(entries(std::string(", obstacle: ") + yes).at(0).handling.grasp) << yes;
  const auto shipped = readObjectEntries(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/config/objects.yaml");
  for (const ObjectEntry& entry : shipped) {
    EXPECT_EQ(entry.handling.obstacle, entry.name == "frame") << entry.name;
    EXPECT_EQ(entry.handling.grasp, entry.name != "frame") << entry.name;
  }
}

TEST(Handling, ItReachesTheModelBase) {
  ViewOptions views;
  views.spacing = 0.6;
  const ModelBase base = compileModels(entries(", grasp: false"), ModelDepth::kViews, views, "none");
  EXPECT_FALSE(base.objects.at(0).handling.grasp);
}

TEST(Handling, MistakesAreNamed) {
  EXPECT_THAT(refusalOf(", grasp: maybe"), HasSubstr("'grasp' is 'maybe'; true or false is expected"));
  EXPECT_THAT(refusalOf(", grasps: []"), HasSubstr("at least one"));
  EXPECT_THAT(refusalOf(", grasps: [3]"), HasSubstr("'grasps[0]' is '3'; a map is expected"));
  EXPECT_THAT(refusalOf(", grasps: [{width: 0.1}]"), HasSubstr("\"xyz\" is missing"));
  EXPECT_THAT(refusalOf(", grasps: [{xyz: [0, 0], width: 0.1}]"),
              HasSubstr("'grasps[0].xyz' is a list of 2; a list of 3 is expected"));
  EXPECT_THAT(refusalOf(", grasps: [{xyz: [0, 0, .nan], width: 0.1}]"), HasSubstr("finite"));
  EXPECT_THAT(refusalOf(", grasps: [{xyz: [0, 0, 0]}]"), HasSubstr("width = 0.0"));
  EXPECT_THAT(refusalOf(", grasps: [{xyz: [0, 0, 0], width: 0.1, rotation_steps: 0}]"),
              HasSubstr("rotation_steps = 0"));
  EXPECT_THAT(refusalOf(", grasps: [{xyz: [0, 0, 0], width: 0.1, axis: [0, 0, 0]}]"), HasSubstr("axis"));
  EXPECT_THAT(refusalOf(", grasps: [{xyz: [0, 0, 0], wide: 0.1}]"),
              HasSubstr("unknown key 'grasps[0].wide'; did you mean 'grasps[0].width'?"));
  EXPECT_THAT(refusalOf(", obstacle: true, grasps: [{xyz: [0, 0, 0], width: 0.1}]"),
              HasSubstr("must not be grasped"));
  EXPECT_THAT(refusalOf(", graps: true"),
              HasSubstr("object 1 (a): unknown key 'graps'; did you mean 'grasps'?"));
}

}  // namespace
}  // namespace monocular_eye_hand
