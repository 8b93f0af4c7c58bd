#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nodes/shared_map.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ModelBase cube() {
  ModelBase models;
  KnownObject object;
  object.model.name = "cube";
  for (int k = 0; k < 8; ++k)
    object.model.mesh.vertices.emplace_back(k & 1 ? 0.02 : -0.02, k & 2 ? 0.02 : -0.02, k & 4 ? 0.04 : 0);
  for (const Eigen::Vector3d& vertex : object.model.mesh.vertices) object.model.bounds.extend(vertex);
  models.objects.push_back(object);
  return models;
}

/// A camera above the table sees a cube whose foot stands at this height.
ObjectView view(double stamp, double height) {
  ObjectView view;
  view.stamp = stamp;
  view.camera.width = 640, view.camera.height = 480;
  view.camera.fx = view.camera.fy = 600, view.camera.cx = 319.5, view.camera.cy = 239.5;
  view.hand.base_from_tool0.rotation = Eigen::Vector3d(1, -1, -1).asDiagonal();
  view.hand.base_from_tool0.translation = {0.5, 0, 0.8};
  view.known.table_height = 0.3;
  SeenObject seen;
  seen.object = 0;
  seen.camera_from_object =
      view.hand.base_from_tool0.inverse() * Rigid3{Eigen::Matrix3d::Identity(), {0.5, 0, height}};
  seen.covariance = 1e-8 * Matrix6d::Identity();
  view.objects.push_back(seen);
  return view;
}

class SharedMapTest : public testing::Test {
 protected:
  SharedMap::Added add(double stamp, double height = 0.3) {
    return map_.add(view(stamp, height), ros::Time(stamp));
  }
  const ModelBase models_ = cube();
  SharedMap map_{models_, {}, "base_link"};
};

TEST_F(SharedMapTest, StampsThatGoBackBeginANewMap) {
  add(1500000000.0);
  const SharedMap::Added late = add(1499999999.5);
  EXPECT_THAT(late.report.refused,
              HasSubstr("the view of 1499999999.500 s is not newer than the last one of"));
  EXPECT_EQ(late.went_back, 0);
  const SharedMap::Added again = add(1499999990.0);
  EXPECT_EQ(again.report.refused, "");
  EXPECT_NEAR(again.went_back, 10, 1e-6);
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

}  // namespace
}  // namespace monocular_eye_hand
