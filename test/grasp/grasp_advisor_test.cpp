#include "monocular_eye_hand/grasp/grasp_advisor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grasp_world.h"

namespace monocular_eye_hand {
namespace {

using namespace grasp_world;
using testing::HasSubstr;

ArmNow armReady() { return {ready(), ""}; }

class GraspAdvisorTest : public testing::Test {
 protected:
  MappedObject at(double x, double y, int object = kBlock, int number = 0, double deviation = 2e-4) const {
    MappedObject mapped;
    mapped.object = object;
    mapped.name = models_.objects[size_t(object)].model.name;
    mapped.number = number;
    mapped.base_from_object.translation = {x, y, kTable};
    mapped.covariance = sigma(deviation, 1e-3);
    return mapped;
  }
  MapState known(const std::vector<MappedObject>& objects) const {
    MapState known;
    known.objects = objects;
    known.stamp = 100;
    known.table_height = kTable;
    return known;
  }
  GraspAnswer ask(const MapState& known, const std::string& name, int number = -1,
                  const ArmNow& arm = armReady()) const {
    return advisor_.answer(name, number, known, arm, 0);
  }

  const ModelBase models_ = partsAndTray();
  const Puma560 arm_;
  const GraspAdvisor advisor_{models_, {}, arm_, tool0FromTcp()};
};

TEST_F(GraspAdvisorTest, Found) {
  const GraspAnswer found = ask(known({at(0.5, 0)}), "block");
  ASSERT_EQ(found.status, GraspStatus::kFound) << found.text;
  EXPECT_EQ(found.index, 0u);
  EXPECT_THAT(found.text, HasSubstr("block 0: "));
  ASSERT_FALSE(found.candidates.empty());
  for (const GraspCandidate& grasp : found.candidates)
    EXPECT_GT(grasp.base_from_grasp.translation.z(), kTable);
}

TEST_F(GraspAdvisorTest, AnyNumberIsTheOneWithTheBestGrasp) {
  const MapState two = known({at(0.5, 0), at(0.4, 0.25, kBlock, 1)});
  const GraspAnswer first = ask(two, "block", 0), second = ask(two, "block", 1), any = ask(two, "block");
  ASSERT_EQ(first.status, GraspStatus::kFound) << first.text;
  ASSERT_EQ(second.status, GraspStatus::kFound) << second.text;
  EXPECT_EQ(first.index, 0u);
  EXPECT_EQ(second.index, 1u);
  const GraspAnswer& better = first.candidates[0].quality >= second.candidates[0].quality ? first : second;
  EXPECT_EQ(any.index, better.index);
  EXPECT_EQ(any.text, better.text);
}

TEST_F(GraspAdvisorTest, EveryAnswer) {
  const MapState block = known({at(0.5, 0), at(0.5, 0.35, kTray)});
  const auto expect = [](const GraspAnswer& answer, GraspStatus status, const std::string& text) {
    EXPECT_EQ(answer.status, status) << answer.text;
    EXPECT_THAT(answer.text, HasSubstr(text));
    EXPECT_FALSE(answer.index);
    EXPECT_TRUE(answer.candidates.empty());
  };
  expect(ask(block, "spoon"), GraspStatus::kUnknownName, "'spoon'; known: block");
  expect(ask(block, ""), GraspStatus::kUnknownName, "''");
  expect(ask(block, "tray"), GraspStatus::kNoGrasp, "tray is an obstacle");
  expect(ask(block, "rod"), GraspStatus::kNotKnown, "no rod is known; known now: block 0, tray 0");
  expect(ask(block, "block", 1), GraspStatus::kNotKnown, "no block 1 is known");
  expect(ask(known({}), "block"), GraspStatus::kNotKnown, "nothing is known now");
  expect(ask(known({at(0.5, 1.5)}), "block"), GraspStatus::kNoGrasp, "block 0: ");
  expect(ask(known({at(0.5, 0, kBlock, 0, 0.01)}), "block"), GraspStatus::kTooUncertain, "block 0: ");

  expect(ask(MapState(), "block"), GraspStatus::kNotReady, "no view was received yet");
  MapState refused;
  refused.refused = "the camera hangs loose";
  expect(ask(refused, "block"), GraspStatus::kNotReady, "the last one: the camera hangs loose");
  expect(ask(block, "block", -1, {ready(), "no joint states"}), GraspStatus::kNotReady, "no joint states");
}

// Also an object that is never grasped, and another one of the same name, are in the way.
TEST_F(GraspAdvisorTest, OtherObjectsAreObstacles) {
  const GraspAnswer free = ask(known({at(0.5, 0)}), "block", 0);
  const GraspAnswer blocked =
      ask(known({at(0.5, 0), at(0.5, 0.034, kBlock, 1), at(0.5, -0.12, kTray)}), "block", 0);
  ASSERT_EQ(free.status, GraspStatus::kFound) << free.text;
  EXPECT_LT(blocked.candidates.size(), free.candidates.size());
}

TEST_F(GraspAdvisorTest, BestOfEachThatMayBeGrasped) {
  const MapState objects = known({at(0.5, 0), at(0.5, 0.35, kTray), at(0.5, 1.5, kRod)});
  const std::vector<BestGrasp> best = advisor_.best(objects, armReady(), 0);
  ASSERT_EQ(best.size(), 2u);  // not the tray
  EXPECT_EQ(best[0].index, 0u);
  ASSERT_TRUE(best[0].grasp);
  EXPECT_EQ(best[0].grasp->quality, ask(objects, "block").candidates.at(0).quality);
  EXPECT_EQ(best[1].index, 2u);
  EXPECT_FALSE(best[1].grasp);
  EXPECT_NE(best[1].reason, "");

  for (const BestGrasp& one : advisor_.best(objects, {ready(), "no joint states"}, 0)) {
    EXPECT_FALSE(one.grasp);
    EXPECT_EQ(one.reason, "no joint states");
  }
}

// A view that told where the table is counts; else the height that is given; without a table nothing does.
TEST_F(GraspAdvisorTest, TheTableIsWhereTheViewSaysOrWhereItIsSaid) {
  MapState untold = known({at(0.5, 0)});
  untold.table_height.reset();
  EXPECT_EQ(advisor_.answer("block", 0, untold, armReady(), kTable).status, GraspStatus::kFound);
  EXPECT_EQ(advisor_.answer("block", 0, untold, armReady(), kTable + 0.1).status, GraspStatus::kNoGrasp);

  GraspingOptions options;
  options.table = false;
  const GraspAdvisor no_table(models_, options, arm_, tool0FromTcp());
  EXPECT_EQ(no_table.answer("block", 0, untold, armReady(), kTable + 0.1).status, GraspStatus::kFound);
}

}  // namespace
}  // namespace monocular_eye_hand
