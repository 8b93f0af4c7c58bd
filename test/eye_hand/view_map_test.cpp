#include "monocular_eye_hand/eye_hand/view_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cube_on_table.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ViewMapTest : public testing::Test {
 protected:
  AddedView add(double stamp, double height = 0.3) {
    went_back_ = map_.beginAgain(stamp);
    return map_.add(cubeView(stamp, height));
  }
  const std::vector<MappedObject>& objects() const { return map_.state().objects; }

  const ModelBase models_ = cube();
  ViewMap map_{&models_, {}};
  double went_back_ = 0;
};

TEST_F(ViewMapTest, StampsThatGoBackBeginANewMap) {
  add(1500000000.0);
  const AddedView late = add(1499999999.5);
  EXPECT_THAT(late.report.refused,
              HasSubstr("the view of 1499999999.500 s is not newer than the last one of"));
  EXPECT_EQ(went_back_, 0);
  const AddedView again = add(1499999990.0);
  EXPECT_EQ(again.report.refused, "");
  EXPECT_NEAR(went_back_, 10, 1e-6);
  ASSERT_EQ(objects().size(), 1u);
  EXPECT_EQ(objects()[0].number, 0);
  EXPECT_EQ(objects()[0].views, 1);
  EXPECT_EQ(add(1499999990.1).report.refused, "");
}

TEST_F(ViewMapTest, WhatCannotBeThereIsTold) {
  add(1, 0.26);
  const MapState known = map_.state();
  EXPECT_TRUE(known.objects.empty());
  EXPECT_THAT(known.ruled_out, ElementsAre("cube: reaches 40.0 mm below the table's top (z = 300.0 mm)"));
  EXPECT_EQ(known.table_height, 0.3);
  add(2);
  EXPECT_TRUE(map_.state().ruled_out.empty());
}

TEST_F(ViewMapTest, AViewFromBeforeAForgetIsNoTrouble) {
  add(1);
  EXPECT_EQ(map_.forget(0, 0, 2), 1);
  const AddedView before = add(1.5);
  EXPECT_TRUE(before.before_forget);
  EXPECT_THAT(before.report.refused, HasSubstr("~forget"));
  EXPECT_TRUE(objects().empty());
  EXPECT_FALSE(add(2.5).before_forget);
  EXPECT_EQ(objects().size(), 1u);
}

TEST_F(ViewMapTest, ForgettingEverythingBeginsAnew) {
  add(10);
  EXPECT_EQ(map_.state().stamp, 10);
  EXPECT_EQ(map_.forget(-1, -1, 20), 1);
  EXPECT_TRUE(objects().empty());
  EXPECT_EQ(map_.forget(-1, -1, 20), 0);
  EXPECT_EQ(add(5).report.refused, "") << "stamps may start again";
  ASSERT_EQ(objects().size(), 1u);
  EXPECT_EQ(objects()[0].number, 0);

  map_.clear();
  EXPECT_FALSE(map_.state().stamp);
  EXPECT_TRUE(objects().empty());
}

TEST_F(ViewMapTest, WhyAViewWasNotUsedIsKept) {
  map_.refuse("no transform");
  EXPECT_EQ(map_.state().refused, "no transform");
  EXPECT_FALSE(map_.state().stamp);
  add(1);
  EXPECT_EQ(map_.state().refused, "");
  EXPECT_NE(add(1).report.refused, "");
  EXPECT_NE(map_.state().refused, "");
  EXPECT_EQ(objects().size(), 1u);
}

}  // namespace
}  // namespace monocular_eye_hand
