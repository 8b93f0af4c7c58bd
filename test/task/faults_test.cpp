#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "scripted_world.h"

namespace monocular_eye_hand {
namespace {

using namespace scripted;
using testing::Contains;
using testing::HasSubstr;

TEST(Faults, ASilentCameraEndsTheTaskWithoutMotion) {
  World world;
  world.put(kBridge, 0, at(0.5, 0));
  world.silent = "no image since 2 s";
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kFault);
  EXPECT_EQ(result.reason, "3 looks failed in a row: no image since 2 s");
  EXPECT_EQ(world.motions, 0);
  EXPECT_EQ(world.log.size(), 3u);
}

TEST(Faults, ARecogniserThatComesBackIsWaitedFor) {
  World world;
  world.put(kBridge, 0, at(0.5, 0));
  world.silent = "recognition does not answer";
  world.silent_looks = 2;
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared);
  EXPECT_EQ(result.rounds, 2);
}

TEST(Faults, ACameraThatFailsBeforePickingMovesNothing) {
  World world;
  world.put(kBridge, 0, at(0.5, 0));
  world.before_look = [&](const TaskView& view) {
    if (view.near) world.silent = "no image since 2 s";
  };
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kFault);
  EXPECT_EQ(world.motions, 0);
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kWaiting);
}

TEST(Faults, AnObjectRemovedBeforeTheNearLookIsNotGrasped) {
  World world;
  world.put(kBridge, 0, at(0.5, 0));
  world.before_look = [&](const TaskView& view) {
    if (view.near) world.thing(kBridge, 0).there = false;
  };
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kGone);
  EXPECT_THAT(object(result, kBridge, 0).reason, HasSubstr("not seen any more"));
  EXPECT_EQ(world.motions, 0);
}

TEST(Faults, AnObjectRemovedAfterTheNearLookIsAnEmptyGripper) {
  World world;
  world.put(kBridge, 0, at(0.5, 0));
  bool looked_near = false;
  world.before_look = [&](const TaskView& view) { looked_near |= view.near; };
  ClearFrameTask task(&kModels, &world);
  while (task.step())
    if (looked_near) world.thing(kBridge, 0).there = false;
  EXPECT_EQ(task.result().outcome, TaskOutcome::kCleared) << task.result().reason;
  EXPECT_EQ(object(task.result(), kBridge, 0).outcome, ObjectOutcome::kGone);
  EXPECT_EQ(object(task.result(), kBridge, 0).picks, 1);
  EXPECT_THAT(world.log, Contains("open"));
}

TEST(Faults, AnObjectThatOnlyAFarViewShowsIsLeft) {
  World world;
  world.put(kBridge, 0, at(0.5, 0)).hidden_from_near = true;
  TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_THAT(object(result, kBridge, 0).reason, HasSubstr("a look from near did not show it"));
  EXPECT_EQ(world.motions, 0);

  World moved;
  moved.put(kBridge, 0, at(0.5, 0)).contradicted = true;
  result = ClearFrameTask(&kModels, &moved).run();
  EXPECT_THAT(object(result, kBridge, 0).reason, HasSubstr("contradicted its pose"));
  EXPECT_EQ(moved.motions, 0);
}

TEST(Faults, ALostGraspIsTriedAgainAndGivenUp) {
  World once;
  once.put(kBridge, 0, at(0.5, 0)).picks = {{ActionOutcome::kGraspLost, "slipped"}};
  TaskResult result = ClearFrameTask(&kModels, &once).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared);
  EXPECT_EQ(object(result, kBridge, 0).picks, 2);

  World always;
  always.put(kBridge, 0, at(0.5, 0)).picks.assign(99, {ActionOutcome::kGraspLost, "slipped"});
  always.put(kGrenade, 0, at(0.5, 0.05));
  result = ClearFrameTask(&kModels, &always).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_EQ(object(result, kBridge, 0).picks, 3);
  EXPECT_THAT(object(result, kBridge, 0).reason, HasSubstr("3 grasps lost; the last one: slipped"));
  EXPECT_EQ(object(result, kGrenade, 0).outcome, ObjectOutcome::kCarried);
}

TEST(Faults, AnEmptyGripperAfterLiftingIsALostGrasp) {
  World world;
  world.put(kBridge, 0, at(0.5, 0));
  world.slips = true;
  const TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared);
  EXPECT_EQ(object(result, kBridge, 0).picks, 2);
}

TEST(Faults, WhatIsDroppedInTheFrameIsPickedUpAgain) {
  World world;
  world.put(kBridge, 0, at(0.5, 0));
  world.carries = {{ActionOutcome::kGraspLost, "the fingers closed"}};
  TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCleared) << result.reason;
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kCarried);

  World away;  // it falls where it is not seen
  away.put(kBridge, 0, at(0.5, 0));
  away.carries = {{ActionOutcome::kGraspLost, "the fingers closed"}};
  bool dropped = false;
  ClearFrameTask task(&kModels, &away, {}, {},
                      [&](const TaskFeedback& f) { dropped |= f.stage == TaskStage::kCarry; });
  away.before_look = [&](const TaskView&) {
    if (dropped) {
      away.thing(kBridge, 0).there = false;
      away.thing(kBridge, 0).misses_left = 0;
    }
  };
  result = task.run();
  EXPECT_EQ(result.outcome, TaskOutcome::kLeftovers);
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kDropped);
  EXPECT_THAT(object(result, kBridge, 0).reason,
              HasSubstr("on the way to the drop zone: the fingers closed"));
}

TEST(Faults, CancelStopsBeforeEveryStage) {
  // However late it comes: no further motion, and a held object is named.
  int stages = 0;
  {
    World world;
    world.put(kBridge, 0, at(0.5, 0));
    ClearFrameTask task(&kModels, &world);
    while (task.step()) ++stages;
  }
  ASSERT_GT(stages, 6);

  bool held = false;
  for (int late = 0; late < stages; ++late) {
    World world;
    world.put(kBridge, 0, at(0.5, 0));
    bool cancel = false;
    ClearFrameTask task(&kModels, &world, {}, [&] { return cancel; });
    for (int k = 0; k < late; ++k) task.step();
    cancel = true;
    const int motions = world.motions;
    const size_t calls = world.log.size();
    const TaskResult result = task.run();

    EXPECT_EQ(result.outcome, TaskOutcome::kCancelled) << late;
    EXPECT_EQ(world.motions, motions);
    EXPECT_EQ(world.log.size(), calls);
    for (const TaskObject& o : result.objects) {
      EXPECT_EQ(o.outcome == ObjectOutcome::kHeld, world.holding);
      if (!world.holding) continue;
      held = true;
      EXPECT_THAT(o.reason, HasSubstr("still in the gripper"));
    }
  }
  EXPECT_TRUE(held);
}

TEST(Faults, CancelDuringAMotionIsHeardFromTheArm) {
  World world;
  world.put(kBridge, 0, at(0.5, 0));
  world.carries = {{ActionOutcome::kCancelled, "stopped on the way"}};
  TaskResult result = ClearFrameTask(&kModels, &world).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kCancelled);
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kHeld);
  EXPECT_THAT(result.reason, HasSubstr("carry of bridge 0: stopped on the way"));
}

TEST(Faults, WhatDoesNotAnswerIsNamed) {
  World planner;
  planner.put(kBridge, 0, at(0.5, 0)).picks = {{ActionOutcome::kFault, "the planner does not answer"}};
  EXPECT_THAT(ClearFrameTask(&kModels, &planner).run().reason, HasSubstr("the planner does not answer"));
  World gripper;
  gripper.put(kBridge, 0, at(0.5, 0));
  gripper.grip_answers = false;
  TaskResult result = ClearFrameTask(&kModels, &gripper).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("the gripper does not answer"));
  EXPECT_EQ(object(result, kBridge, 0).outcome, ObjectOutcome::kHeld);

  World stuck;
  stuck.put(kBridge, 0, at(0.5, 0)).picks = {{ActionOutcome::kGraspLost, "slipped"}};
  stuck.opens = {ActionOutcome::kFault, "no state"};
  EXPECT_THAT(ClearFrameTask(&kModels, &stuck).run().reason,
              HasSubstr("the gripper does not open: no state"));
  World broken;
  broken.before_look = [](const TaskView&) { throw std::runtime_error("tf is gone"); };
  result = ClearFrameTask(&kModels, &broken).run();
  EXPECT_EQ(result.outcome, TaskOutcome::kFault);
  EXPECT_EQ(result.reason, "stage look: tf is gone");
}

}  // namespace
}  // namespace monocular_eye_hand
