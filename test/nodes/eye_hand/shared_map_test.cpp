#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cube_on_table.h"
#include "monocular_eye_hand/model/build_model.h"
#include "nodes/eye_hand/shared_map.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A camera above the table sees a cube whose foot stands at this height.
ObjectView view(double stamp, double height) {
  ObjectView view;
  view.stamp = stamp;
  view.camera.width = 640;
  view.camera.height = 480;
  view.camera.fx = view.camera.fy = 600;
  view.camera.cx = 319.5;
  view.camera.cy = 239.5;
  view.hand.base_from_tool0 = lookingDown(0.5, 0, 0.8);
  view.known.table_height = 0.3;
  view.objects.push_back(seenCube(view.hand.base_from_tool0, {0.5, 0, height}));
  return view;
}

class SharedMapTest : public testing::Test {
 protected:
  SharedMap::Added add(double stamp, double height = 0.3) {
    went_back_ = map_.beginAgain(ros::Time(stamp));
    return map_.add(view(stamp, height), ros::Time(stamp));
  }
  const ModelBase models_ = cube();
  SharedMap map_{models_, {}, "base_link"};
  double went_back_ = 0;
};

TEST_F(SharedMapTest, StampsThatGoBackBeginANewMap) {
  add(1500000000.0);
  const SharedMap::Added late = add(1499999999.5);
  EXPECT_THAT(late.report.refused,
              HasSubstr("the view of 1499999999.500 s is not newer than the last one of"));
  EXPECT_EQ(went_back_, 0);
  const SharedMap::Added again = add(1499999990.0);
  EXPECT_EQ(again.report.refused, "");
  EXPECT_NEAR(went_back_, 10, 1e-6);
  ASSERT_EQ(map_.known().messages.size(), 1u);
  EXPECT_EQ(map_.known().messages[0].instance, 0);
  EXPECT_EQ(map_.known().messages[0].views, 1);
  EXPECT_EQ(add(1499999990.1).report.refused, "");
}

TEST_F(SharedMapTest, WhatCannotBeThereIsTold) {
  add(1, 0.26);
  const KnownObjects known = map_.known();
  EXPECT_TRUE(known.objects.empty());
  EXPECT_THAT(known.ruled_out, ElementsAre("cube: reaches 40.0 mm below the table's top (z = 300.0 mm)"));
  EXPECT_EQ(known.table_height, 0.3);
  add(2);
  EXPECT_TRUE(map_.known().ruled_out.empty());
}

TEST_F(SharedMapTest, AViewFromBeforeAForgetIsNoTrouble) {
  add(1);
  EXPECT_EQ(map_.forget(0, 0, ros::Time(2)), 1);
  const SharedMap::Added before = add(1.5);
  EXPECT_TRUE(before.before_forget);
  EXPECT_THAT(before.report.refused, HasSubstr("~forget"));
  EXPECT_TRUE(map_.known().messages.empty());
  EXPECT_FALSE(add(2.5).before_forget);
  EXPECT_EQ(map_.known().messages.size(), 1u);
}

/// A solid block whose foot's middle is the origin: two of them cannot be in one place.
ModelBase block() {
  Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back(k & 1 ? 0.02 : -0.02, k & 2 ? 0.03 : -0.03, k & 4 ? 0.05 : 0);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  ModelBase models;
  models.objects.push_back({buildModel("block", mesh), {}});
  return models;
}

TEST(SharedMap, WhatHadYieldedHasTheStampOfItsLastView) {
  const ModelBase models = block();
  SharedMap map(models, {}, "base_link");
  const auto see = [&](int stamp, const std::vector<Eigen::Vector3d>& feet) {
    ObjectView seen = view(stamp, 0.3);
    const Rigid3 camera = lookingDown(0.4 + 0.02 * stamp, 0, 0.8);
    seen.hand.base_from_tool0 = camera;
    seen.objects.clear();
    for (const Eigen::Vector3d& foot : feet) seen.objects.push_back(seenCube(camera, foot));
    map.add(seen, ros::Time(stamp));
  };
  const Eigen::Vector3d there(0.5, 0, 0.3), beside(0.53, 0, 0.3);
  for (int stamp = 1; stamp <= 8; ++stamp) see(stamp, {there});
  for (int stamp = 9; stamp <= 11; ++stamp) see(stamp, {});
  see(12, {beside});
  ASSERT_EQ(map.known().messages.size(), 1u);
  EXPECT_EQ(map.known().messages[0].instance, 0);
  see(13, {});  // the first one was missed for the fifth time
  ASSERT_EQ(map.known().messages.size(), 1u);
  EXPECT_EQ(map.known().messages[0].instance, 1);
  EXPECT_EQ(map.known().messages[0].header.stamp, ros::Time(12));
}

}  // namespace
}  // namespace monocular_eye_hand
