#include "monocular_eye_hand/task/clear_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/options.h"
#include "scripted_world.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using namespace scripted;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(ClearFrame, CarriesEverythingOut) {
  World world;
  world.put(kBridge, 0, at(0.45, 0.05));
  world.put(kBridge, 1, at(0.55, -0.05));
  world.put(kGrenade, 0, at(0.5, 0.0));
  world.put(kGrenade, 1, at(0.9, 0.0));  // beside the frame
  std::vector<TaskFeedback> told;
  ClearFrameTask task(&kModels, &world, {}, {}, [&](const TaskFeedback& f) { told.push_back(f); });

  const TaskResult result = task.run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("3 carried out"));
  ASSERT_EQ(result.objects.size(), 3u);
  for (const TaskObject& o : result.objects) {
    EXPECT_EQ(o.outcome, ObjectOutcome::kCarried);
    EXPECT_EQ(o.picks, 1);
    EXPECT_EQ(o.near_looks, 1);
  }

  EXPECT_EQ(result.rounds, 4);
  EXPECT_EQ(world.motions, 6);
  EXPECT_THAT(std::vector<std::string>(world.log.begin(), world.log.begin() + 7),
              ElementsAre("overview 0", "overview 1", "overview 2", "near bridge0", "pick bridge0 by grasp 0",
                          "carry bridge0 to 0", "overview 0"));
  EXPECT_THAT(world.log, Not(Contains(HasSubstr("grenade1"))));

  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back().stage, TaskStage::kDone);
  EXPECT_EQ(told.back().carried, 3);
  const auto about = [&](TaskStage stage) {
    return std::count_if(told.begin(), told.end(), [&](const auto& f) { return f.stage == stage; });
  };
  for (const TaskStage stage : {TaskStage::kLook, TaskStage::kChoose, TaskStage::kConfirm, TaskStage::kPick,
                                TaskStage::kVerify, TaskStage::kCarry})
    EXPECT_GE(about(stage), 3) << toString(stage);
  EXPECT_FALSE(task.step());
}

// The grasps of both are asked for before one is picked, and the map moves on in between.
TEST(ClearFrame, AGraspGoesToThePlannerWithTheObjectItWasPlannedFor) {
  World world;
  world.put(kBridge, 0, at(0.45, 0.05));
  world.put(kBridge, 1, at(0.55, -0.05));
  world.planned_from_map = at(0.002, -0.001);
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;

  ASSERT_EQ(world.picked.size(), 2u);
  for (int number = 0; number < 2; ++number) {
    const PlannedGrasp& planned = world.picked[size_t(number)];
    EXPECT_EQ(planned.object.object, kBridge);
    EXPECT_EQ(planned.object.number, number);
    EXPECT_EQ(planned.grasp.source, "grasp 0");
    const Rigid3 planned_for = world.thing(kBridge, number).object.base_from_object * world.planned_from_map;
    EXPECT_EQ(planned.object.base_from_object.translation, planned_for.translation);
  }
}

TEST(ClearFrame, AnEmptyFrameIsCleared) {
  World world;
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared);
  EXPECT_TRUE(result.objects.empty());
  EXPECT_EQ(world.motions, 0);
}

TEST(ClearFrame, WithoutAFrameNothingMoves) {
  World world;
  world.things.clear();
  world.put(kBridge, 0, at(0.5, 0));
  TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kNoFrame);
  EXPECT_THAT(result.reason, HasSubstr("no frame was found"));
  EXPECT_EQ(world.motions, 0);
  ClearFrameOptions table;
  table.frame = "";  // the whole table
  result = ClearFrameTask(&kModels, &world, table).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared);
  EXPECT_EQ(world.motions, 2);
}

TEST(ClearFrame, AnUncertainPoseIsLookedAtFromNearer) {
  World world;
  world.put(kBridge, 0, at(0.5, 0)).uncertain = 2;
  TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared);
  EXPECT_THAT(world.log, Contains("near bridge1"));
  EXPECT_EQ(object(result, kBridge, 0).near_looks, 2);

  World hopeless;
  hopeless.put(kBridge, 0, at(0.5, 0)).uncertain = 99;
  result = ClearFrameTask(&kModels, &hopeless).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kLeft);
  EXPECT_THAT(object(result, kBridge, 0).reason,
              HasSubstr("3 looks from near, and still: 3 sigma need 9 mm"));
  EXPECT_EQ(hopeless.motions, 0);
  EXPECT_THAT(hopeless.log, Contains("near bridge2"));
}

TEST(ClearFrame, AGraspWithoutRoomIsNotTried) {
  World world;
  world.put(kBridge, 0, at(0.5, 0));
  world.clearance_fits = false;
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_THAT(object(result, kBridge, 0).reason, HasSubstr("no grasp leaves room"));
  EXPECT_EQ(world.motions, 0);
}

TEST(ClearFrame, UnreachableStaysWithItsReasonTheOthersGo) {
  World world;
  world.put(kBridge, 0, at(0.5, 0)).refused = "bridge: of 80 grasps 80 unreachable";
  world.put(kGrenade, 0, at(0.55, 0));
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_THAT(result.reason, HasSubstr("bridge 0: bridge: of 80 grasps 80 unreachable"));
  EXPECT_EQ(object(result, kGrenade, 0).outcome, ObjectOutcome::kCarried);
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kLeft);
}

TEST(ClearFrame, WhatOthersBlockIsTriedAgainWhenTheyAreGone) {
  World world;
  world.put(kBridge, 0, at(0.5, 0)).blocked_by_others = true;
  world.put(kGrenade, 0, at(0.55, 0));
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kCarried);
}

TEST(ClearFrame, TheNextGraspIsTriedWhenOneHasNoPath) {
  World world;
  world.put(kBridge, 0, at(0.5, 0)).picks = {{ActionOutcome::kInCollision, "gripper and frame"},
                                             {ActionOutcome::kUnreachable, "limits"}};
  TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared);
  EXPECT_THAT(world.log, Contains("pick bridge0 by grasp 2"));
  EXPECT_EQ(object(result, kBridge, 0).picks, 1);

  World closed;
  closed.put(kBridge, 0, at(0.5, 0)).picks.assign(99, {ActionOutcome::kInCollision, "gripper and frame"});
  result = ClearFrameTask(&kModels, &closed).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_THAT(object(result, kBridge, 0).reason,
              HasSubstr("none of 3 grasps has a path; the last one: in collision: gripper and frame"));
  EXPECT_EQ(closed.motions, 0);
}

TEST(ClearFrame, WhatHasNoPathLetsTheOthersGoFirst) {
  World world;
  world.put(kBridge, 0, at(0.5, 0)).picks.assign(3, {ActionOutcome::kInCollision, "it and grenade 0"});
  world.put(kGrenade, 0, at(0.55, 0));
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  const auto first = [&](const std::string& what) {
    return std::find(world.log.begin(), world.log.end(), what) - world.log.begin();
  };
  EXPECT_LT(first("pick bridge0 by grasp 2"), first("carry grenade0 to 0"));
  EXPECT_LT(first("carry grenade0 to 0"), first("carry bridge0 to 1"));
}

TEST(ClearFrame, WhatASecondLookShowsFreeIsNotGivenUp) {
  // What stood in the way was seen wrongly.
  World world;
  world.put(kBridge, 0, at(0.5, 0)).picks.assign(3, {ActionOutcome::kInCollision, "lift: grenade 3"});
  TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kCarried);

  World refused;
  refused.put(kBridge, 0, at(0.5, 0)).refused = "meets an obstacle";
  refused.before_look = [&](const TaskView&) {
    if (refused.log.size() == 3) refused.thing(kBridge, 0).refused.clear();
  };
  result = ClearFrameTask(&kModels, &refused).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;

  World never;
  never.put(kBridge, 0, at(0.5, 0)).refused = "meets an obstacle";
  ClearFrameOptions options;
  options.blocked_rounds = 4;
  result = ClearFrameTask(&kModels, &never, options).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_EQ(result.rounds, 4);
  EXPECT_EQ(never.motions, 0);
}

TEST(ClearFrame, WhatOnlyASearchShowsIsCarriedOutToo) {
  World world;
  World::Thing& bridge = world.put(kBridge, 0, at(0.5, 0));
  bridge.there = false;
  bridge.misses_left = 0;
  world.before_look = [&](const TaskView& view) {
    if (view.overview < 0 && world.motions == 0) world.thing(kBridge, 0).there = true;
  };
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared);
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kCarried);
  EXPECT_EQ(std::count(world.log.begin(), world.log.end(), "search"), 5);  // the one, and four after it
}

TEST(ClearFrame, WhatViewsMissedIsLeftToTheMap) {
  ClearFrameOptions options;
  for (int misses = 0; misses <= options.doubtful_misses; ++misses) {
    World world;
    world.put(kBridge, 0, at(0.5, 0)).object.misses = misses;
    const TaskResult result = ClearFrameTask(&kModels, &world, options).run();
    EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << misses;
    EXPECT_EQ(world.motions > 0, misses < options.doubtful_misses) << misses;
  }
}

TEST(ClearFrame, WhatWasGivenUpIsTriedAgainWhenSomethingWasCarriedOut) {
  World world;
  world.put(kBridge, 0, at(0.5, 0)).hidden_from_near = true;
  world.put(kGrenade, 0, at(0.55, 0));
  world.before_look = [&](const TaskView&) {
    if (world.motions > 0) world.thing(kBridge, 0).hidden_from_near = false;
  };
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kCarried);
}

TEST(ClearFrame, RoundsAreBounded) {
  // Every object that is carried away is replaced.
  World world;
  world.put(kBridge, 0, at(0.5, 0));
  world.before_look = [&](const TaskView& view) {
    if (view.overview == 0 && !world.things.back().there)
      world.put(kBridge, int(world.things.size()), at(0.5, 0));
  };
  ClearFrameOptions options;
  options.max_rounds = 5;
  const TaskResult result = ClearFrameTask(&kModels, &world, options).run();
  EXPECT_EQ(result.rounds, 5);
  EXPECT_LE(world.motions, 10);
  EXPECT_NE(result.outcome, TaskOutcome::kFault);
}

TEST(ClearFrame, BadInputIsNamed) {
  World world;
  ClearFrameOptions options;
  options.frame = "tray";
  EXPECT_THAT(refusal([&] { ClearFrameTask(&kModels, &world, options); }),
              HasSubstr("frame = \"tray\" is not in the model base (bridge, grenade, frame)"));
  EXPECT_THROW(readOptions(parseYaml("overviews: 0"), &options), BadInput);
  EXPECT_THROW(readOptions(parseYaml("frame_margin: -1"), &options), BadInput);
  EXPECT_THROW(readOptions(parseYaml("look_attempt: 2"), &options), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
