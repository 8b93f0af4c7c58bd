#include "monocular_eye_hand/grasp/object_grasps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grasp_world.h"

namespace monocular_eye_hand {
namespace {

using namespace grasp_world;

MappedObject at(double x, double y, int object = kBlock, int number = 0) {
  MappedObject mapped;
  mapped.object = object;
  mapped.number = number;
  mapped.base_from_object.translation = {x, y, kTable};
  mapped.covariance = sigma(2e-4, 1e-3);
  return mapped;
}

class ObjectGraspsTest : public testing::Test {
 protected:
  const ModelBase models_ = partsAndTray();
  const Puma560 arm_;
  const ObjectGrasps grasps_{&models_, &arm_, tool0FromTcp(), {}, {}, {}};
};

TEST_F(ObjectGraspsTest, WhatIsAnObstacleMayNotBeGrasped) {
  EXPECT_TRUE(grasps_.mayGrasp(kBlock));
  EXPECT_FALSE(grasps_.ofModel(kBlock).grasps.empty());
  EXPECT_FALSE(grasps_.mayGrasp(kTray));
  EXPECT_TRUE(grasps_.ofModel(kTray).grasps.empty());
  EXPECT_NE(grasps_.ofModel(kTray).reason, "");
}

// The plan is that of planGrasps with the others and the table around.
TEST_F(ObjectGraspsTest, TheOthersAndTheTableAreInTheWay) {
  const std::vector<MappedObject> objects{at(0.5, 0.0), at(0.5, 0.034, kBlock, 1), at(0.5, 0.3, kTray)};
  GraspScene scene;
  scene.table_height = kTable;
  scene.obstacles = {{&models_.objects[kBlock].model, objects[1].base_from_object},
                     {&models_.objects[kTray].model, objects[2].base_from_object}};
  const GraspPlan expected =
      planGrasps({&models_.objects[kBlock].model, objects[0].base_from_object, objects[0].covariance},
                 grasps_.ofModel(kBlock), scene, {}, arm_, tool0FromTcp(), ready());
  const GraspPlan found = grasps_.plan(objects, 0, kTable, ready());
  ASSERT_FALSE(found.candidates.empty()) << found.reason;
  ASSERT_EQ(found.candidates.size(), expected.candidates.size());
  for (size_t k = 0; k < found.candidates.size(); ++k) {
    EXPECT_EQ(found.candidates[k].model_grasp, expected.candidates[k].model_grasp);
    EXPECT_EQ(found.candidates[k].grasp_joints, expected.candidates[k].grasp_joints);
  }

  const auto refusedBy = [](const GraspPlan& plan, GraspRefusal refusal) {
    for (const RefusalCount& one : plan.refusals)
      if (one.refusal == refusal) return one.count;
    return 0;
  };
  EXPECT_GT(refusedBy(found, GraspRefusal::kObstacle), 0);
  EXPECT_GT(refusedBy(found, GraspRefusal::kTable), 0);
  const GraspPlan alone = grasps_.plan({objects[0]}, 0, std::nullopt, ready());
  EXPECT_EQ(refusedBy(alone, GraspRefusal::kObstacle), 0);
  EXPECT_EQ(refusedBy(alone, GraspRefusal::kTable), 0);
}

TEST_F(ObjectGraspsTest, PlansAreThoseOfTheModelAndNumberAskedFor) {
  const std::vector<MappedObject> objects{at(0.5, 0.3, kTray), at(0.5, 0.0, kBlock, 3),
                                          at(0.5, -0.2, kBlock, 5)};
  const auto indices = [&](int object, int number) {
    std::vector<size_t> indices;
    for (const ObjectGraspPlan& one : grasps_.plans(objects, object, number, kTable, ready()))
      indices.push_back(one.index);
    return indices;
  };
  EXPECT_THAT(indices(kBlock, -1), testing::ElementsAre(1, 2));
  EXPECT_THAT(indices(kBlock, 5), testing::ElementsAre(2));
  EXPECT_THAT(indices(kBlock, 4), testing::IsEmpty());
}

TEST(BestOf, TheFirstOfEquals) {
  const auto planOf = [](size_t index, std::vector<double> qualities) {
    ObjectGraspPlan one;
    one.index = index;
    for (const double quality : qualities) {
      one.plan.candidates.emplace_back();
      one.plan.candidates.back().quality = quality;
    }
    return one;
  };
  EXPECT_EQ(bestOf({}), nullptr);
  const std::vector<ObjectGraspPlan> none{planOf(0, {})};
  EXPECT_EQ(bestOf(none), nullptr);
  const std::vector<ObjectGraspPlan> plans{planOf(0, {}), planOf(1, {0.5, 0.4}), planOf(2, {0.7, 0.1}),
                                           planOf(3, {0.7, 0.6})};
  EXPECT_EQ(bestOf(plans)->index, 2u);
}

}  // namespace
}  // namespace monocular_eye_hand
