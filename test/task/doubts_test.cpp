// What one view showed and no later one: a doubt, told and not counted. And how long is waited before a
// retry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripted_world.h"

namespace monocular_eye_hand {
namespace {

using namespace scripted;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A world in which phantoms show in the first looks only, and stay in the map.
class PhantomWorld : public World {
 public:
  TaskLook look(const TaskView& view) override {
    TaskLook seen = World::look(view);
    ++looks_;
    for (MappedObject& object : seen.objects)
      if (object.name == "grenade" && looks_ > shown) object.last_stamp = shown;
    return seen;
  }
  void wait(double seconds) override { waits.push_back(seconds); }

  int shown = 1;  // looks that show the grenades
  std::vector<double> waits;

 private:
  int looks_ = 0;
};

World::Thing& putPhantom(PhantomWorld* world) {
  World::Thing& phantom = world->put(kGrenade, 0, at(0.55, 0));
  phantom.object.views = 1;
  phantom.refused = "every grasp meets the table";
  return phantom;
}

TEST(Doubts, OneSightingThatNoSearchConfirmsIsADoubt) {
  PhantomWorld world;
  world.put(kBridge, 0, at(0.5, 0)).object.views = 2;
  putPhantom(&world);
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_EQ(object(result, kGrenade, 0).outcome, ObjectOutcome::kDoubt);
  EXPECT_THAT(object(result, kGrenade, 0).reason, HasSubstr("one view showed it"));
  EXPECT_THAT(object(result, kGrenade, 0).reason, HasSubstr("every grasp meets the table"));
  EXPECT_THAT(result.reason, HasSubstr("1 carried out; in doubt: grenade 0"));
}

TEST(Doubts, ANearLookThatDoesNotShowItIsOneMore) {
  PhantomWorld world;
  World::Thing& phantom = putPhantom(&world);
  phantom.refused.clear();
  phantom.hidden_from_near = true;
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_EQ(object(result, kGrenade, 0).outcome, ObjectOutcome::kDoubt);
  EXPECT_EQ(world.motions, 0);
}

TEST(Doubts, WhatSeveralViewsAgreeOnIsLeftOver) {
  PhantomWorld world;
  putPhantom(&world).object.views = 2;
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_EQ(object(result, kGrenade, 0).outcome, ObjectOutcome::kLeft);
}

TEST(Doubts, WhatNoViewShowedSurelyIsADoubt) {
  PhantomWorld world;
  World::Thing& phantom = putPhantom(&world);
  phantom.object.views = 2;
  phantom.object.probability = 0.67;
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_EQ(object(result, kGrenade, 0).outcome, ObjectOutcome::kDoubt);
  EXPECT_THAT(object(result, kGrenade, 0).reason, HasSubstr("no view showed it surely"));
}

TEST(Doubts, WhatViewsTogetherHardlyBelieveIsLookedAtFromNear) {
  for (const double probability : {0.67, 0.95}) {
    World world;
    World::Thing& bridge = world.put(kBridge, 0, at(0.5, 0));
    bridge.object.views = 2;
    bridge.object.probability = probability;
    EXPECT_EQ(ClearFrameTask(&kModels, &world).run().outcome, TaskOutcome::kCleared);
    EXPECT_EQ(std::count(world.log.begin(), world.log.end(), "near bridge0"), probability < 0.8 ? 1 : 0);
  }
}

TEST(Doubts, WhatOneViewShowedSurelyAndLaterOnesMissIsLookedForFromNear) {
  for (const double probability : {0.95, 0.6}) {
    World world;
    World::Thing& bridge = world.put(kBridge, 0, at(0.5, 0));
    bridge.misses_left = 0;
    bridge.object.probability = probability;
    world.before_look = [&](const TaskView& view) {
      world.thing(kBridge, 0).there = world.motions == 0 && (view.overview == 0 || view.near);
    };
    ClearFrameTask(&kModels, &world).run();
    const auto first = [&](const char* what) {
      return std::find(world.log.begin(), world.log.end(), what) - world.log.begin();
    };
    EXPECT_EQ(first("near bridge0") < first("search"), probability > 0.8);
  }
}

TEST(Doubts, WhatWasTakenAwayIsLookedForInVain) {
  World world;
  world.put(kBridge, 0, at(0.5, 0)).misses_left = 0;
  world.before_look = [&](const TaskView& view) { world.thing(kBridge, 0).there = view.overview == 0; };
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kGone);
  EXPECT_EQ(std::count(world.log.begin(), world.log.end(), "near bridge0"), 2);
}

TEST(Doubts, WhatALaterLookShowsSurelyIsTriedAgain) {
  World world;
  World::Thing& bridge = world.put(kBridge, 0, at(0.5, 0));
  bridge.contradicted = true;
  int near_looks = 0;
  world.before_look = [&](const TaskView& view) {
    if (view.near && ++near_looks > 2) world.thing(kBridge, 0).contradicted = false;
  };
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kCarried);
  EXPECT_EQ(near_looks, 3);
}

TEST(Doubts, WhatTheLastLooksShowIsLeftOver) {
  PhantomWorld world;
  world.shown = 1000;
  putPhantom(&world);
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_THAT(result.reason, Not(HasSubstr("doubt")));
}

TEST(Doubts, WhatIsLeftAndWhatIsInDoubtAreTold) {
  PhantomWorld world;
  putPhantom(&world);
  world.put(kBridge, 0, at(0.5, 0)).refused = "out of reach";
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_THAT(result.reason, HasSubstr("1 left in the frame or dropped; bridge 0"));
  EXPECT_THAT(result.reason, HasSubstr("in doubt: grenade 0"));
}

TEST(Retries, WaitLongerEachTime) {
  PhantomWorld world;
  world.silent = "no image";
  ClearFrameOptions options;
  options.look_attempts = 4;
  options.retry_wait = 1.5;
  ClearFrameTask(&kModels, &world, options).run();
  EXPECT_THAT(world.waits, ElementsAre(1.5, 3, 6));
}

TEST(Retries, BeginAgainAfterALookThatWorked) {
  PhantomWorld world;
  world.silent = "no image";
  world.silent_looks = 2;
  bool again = false;
  world.before_look = [&](const TaskView& view) {
    if (view.overview != 1 || again) return;
    again = true;
    world.silent = "no image";
    world.silent_looks = 1;
  };
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared);
  EXPECT_THAT(world.waits, ElementsAre(2, 4, 2));
}

}  // namespace
}  // namespace monocular_eye_hand
