#include "monocular_eye_hand/eye_hand/known_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map_world.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/interior.h"

namespace monocular_eye_hand {
namespace {

using namespace map_world;
using testing::HasSubstr;

constexpr double kTable = 0.3;
const Eigen::Vector3d kOnTable(0.45, 0, kTable);
const Eigen::Vector3d kLeftEye = kOnTable + Eigen::Vector3d(0, 0.2, 0.5),
                      kRightEye = kOnTable + Eigen::Vector3d(0, -0.2, 0.5);

Rigid3 standing(double x, double y, double z) {
  Rigid3 pose = upright(x, y);
  pose.translation.z() = z;
  return pose;
}

ObjectView above(double stamp, const Eigen::Vector3d& eye,
                 const std::vector<std::pair<int, Rigid3>>& objects) {
  ObjectView seen = view(stamp, eye, kOnTable, objects);
  seen.known.table_height = kTable;
  return seen;
}

class KnownSpaceTest : public testing::Test {
 protected:
  std::string reason(int object, const Rigid3& pose, double sigma = 0) const {
    const ObjectModel& model = models().objects[size_t(object)].model;
    return reachesIntoKnown(model, innerPoints(model, 0.004), pose, diagonal(sigma, 0), space_, {0.004, 3});
  }
  void addBox(const std::string& name, const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
    space_.boxes.push_back({name, {Eigen::Matrix3d::Identity(), centre}, size});
  }
  KnownSpace space_;
};

TEST_F(KnownSpaceTest, NothingIsKnownNothingIsRuledOut) {
  EXPECT_EQ(reason(kBridge, standing(0.4, 0, -5)), "");
}

TEST_F(KnownSpaceTest, WhatStandsOnTheTableMayBeThere) {
  space_.table_height = kTable;
  for (const int object : {kBridge, kFlange, kFrame, kBracket})
    for (const double above : {0.0, 0.002, 0.05, -0.003}) {
      const double foot = models().objects[size_t(object)].model.bounds.min().z();
      EXPECT_EQ(reason(object, standing(0.4, 0, kTable + above - foot)), "") << object << " " << above;
    }
}

TEST_F(KnownSpaceTest, BelowTheTableThereIsNothing) {
  space_.table_height = kTable;
  EXPECT_EQ(reason(kBridge, standing(0.4, 0, kTable - 0.01)),
            "reaches 10.0 mm below the table's top (z = 300.0 mm)");
  EXPECT_THAT(reason(kBracket, standing(0.4, 0, kTable - 0.04)), HasSubstr("40.0 mm below"));
  EXPECT_THAT(reason(kBridge, standing(0.4, 0, kTable - 1)), HasSubstr("below the table's top"));
}

TEST_F(KnownSpaceTest, ATiltReachesBelowToo) {
  space_.table_height = kTable;
  Rigid3 pose = standing(0.4, 0, kTable);
  pose.rotation = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_THAT(reason(kBridge, pose), HasSubstr("below the table's top"));
}

TEST_F(KnownSpaceTest, AnUncertainPoseIsNoContradiction) {
  space_.table_height = kTable;
  EXPECT_NE(reason(kBridge, standing(0.4, 0, kTable - 0.01), 0.001), "");
  EXPECT_EQ(reason(kBridge, standing(0.4, 0, kTable - 0.01), 0.004), "");
}

TEST_F(KnownSpaceTest, AWallIsNamed) {
  addBox("post", {0.4, 0.1, 0.5}, {0.05, 0.05, 1});
  EXPECT_EQ(reason(kBridge, standing(0.4, 0.1, kTable)), "reaches into post");
  EXPECT_EQ(reason(kBridge, standing(0.4, -0.1, kTable)), "");
}

TEST_F(KnownSpaceTest, AThinWallThroughALargePartIsFound) {
  addBox("sheet", {0.4, 0, 0.31}, {0.002, 0.5, 0.5});  // through the frame's rims
  EXPECT_EQ(reason(kFrame, standing(0.4, 0, kTable)), "reaches into sheet");
  EXPECT_EQ(reason(kFrame, standing(0.7, 0, kTable)), "");
}

TEST_F(KnownSpaceTest, ASmallBoxInsideAPartIsFound) {
  // What the hand holds: between its pads there is one thing only.
  const Eigen::Vector3d inside = innerPoints(models().objects[kBridge].model, 0.004).front();
  addBox("what the hand holds", standing(0.4, 0, kTable) * inside, {0.004, 0.004, 0.004});
  EXPECT_EQ(reason(kBridge, standing(0.4, 0, kTable)), "reaches into what the hand holds");
}

TEST(ObjectMapKnowsTheCell, WhatReachesBelowTheTableIsRefused) {
  ObjectMap map(&models());
  const ViewReport report = map.add(above(1, kLeftEye,
                                          {{kBridge, standing(0.40, 0.06, kTable - 0.016)},
                                           {kBracket, standing(0.45, 0.0, kTable - 0.040)},
                                           {kBridge, standing(0.50, -0.06, kTable)}}));
  for (const int phantom : {0, 1}) {
    EXPECT_EQ(report.decisions[size_t(phantom)].outcome, ViewOutcome::kRefused);
    EXPECT_TRUE(report.decisions[size_t(phantom)].impossible);
    EXPECT_THAT(report.decisions[size_t(phantom)].reason, HasSubstr("below the table's top"));
  }
  EXPECT_EQ(report.decisions[2].outcome, ViewOutcome::kNew);
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_NEAR(map.objects()[0].base_from_object.translation.y(), -0.06, 1e-9);
}

TEST(ObjectMapKnowsTheCell, WhatIsLocatedBadlyOnceIsNotMissed) {
  ObjectMap map(&models());
  map.add(above(1, kLeftEye, {{kBridge, standing(0.40, 0.06, kTable)}}));
  const ViewReport bad = map.add(above(2, kRightEye, {{kBridge, standing(0.40, 0.06, kTable - 0.016)}}));
  EXPECT_TRUE(bad.decisions[0].impossible);
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].misses, 0);
  EXPECT_EQ(map.objects()[0].views, 1);
  map.add(above(3, kLeftEye, {}));
  EXPECT_EQ(map.objects()[0].misses, 1);
}

TEST(ObjectMapKnowsTheCell, APhantomOfAnotherNameIsNoSighting) {
  ObjectMap map(&models());
  map.add(above(1, kLeftEye, {{kBridge, standing(0.40, 0.06, kTable)}}));
  map.add(above(2, kRightEye, {{kBracket, standing(0.40, 0.06, kTable - 0.03)}}));
  EXPECT_EQ(map.objects()[0].misses, 1);
}

TEST(ObjectMapKnowsTheCell, TolerancesAreOptions) {
  ObjectMapOptions options;
  options.known_depth = 0.05;
  ObjectMap map(&models(), options);
  map.add(above(1, kLeftEye, {{kBracket, standing(0.45, 0.0, kTable - 0.040)}}));
  EXPECT_EQ(map.objects().size(), 1u);
  options.known_depth = -1;
  EXPECT_THROW(ObjectMap(&models(), options), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
