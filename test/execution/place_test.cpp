#include "executor_world.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Place : public ExecutorTest {
 protected:
  void takeIt(int place = 0) {
    const ActionResult picked = pick(place);
    ASSERT_TRUE(picked.done()) << picked.reason;
    planned = shown;
    robot.sent.clear();
    robot.commands.clear();
  }
  /// The trajectory that carries it is the one that was planned with the pick.
  bool keptPlanUsed() const {
    const auto& sent = robot.sent.at(0).points;
    const auto& kept = planned.at(planned.size() - 3).points;
    if (sent.size() != kept.size()) return false;
    for (size_t k = 0; k < sent.size(); ++k)
      if (sent[k].position != kept[k].position || sent[k].time_s != kept[k].time_s) return false;
    return true;
  }

  std::vector<Trajectory> planned;
};

TEST_F(Place, PutsThePartDown) {
  takeIt();
  robot.on_step = nullptr;
  const ActionResult result = place();
  ASSERT_TRUE(result.done()) << result.reason;
  EXPECT_THAT(stages, ElementsAre("plan", "carry", "lower", "open", "retreat"));
  EXPECT_EQ(executor->held(), "");
  EXPECT_EQ(executor->scene().remembered(), 1u);
  EXPECT_FALSE(memory.kept());
  EXPECT_NEAR(robot.width, 0.06, 1e-6);
  EXPECT_THAT(robot.commands, ElementsAre("arm", "arm", "gripper", "arm"));
  EXPECT_EQ(robot.sent_stops, 0);
}

TEST_F(Place, UsesTheKeptPlan) {
  takeIt();
  EXPECT_TRUE(place().done());
  EXPECT_TRUE(keptPlanUsed());
}

TEST_F(Place, AnotherPlaceNeedsAnotherPlan) {
  takeIt();
  const ActionResult result = place(1);
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_FALSE(keptPlanUsed());
}

TEST_F(Place, AnArmThatMovedNeedsAnotherPlan) {
  takeIt();
  robot.joints[0] += 0.9 * ExecutionOptions().start_tolerance;
  robot.wait(0.01);
  EXPECT_TRUE(place().done());
  EXPECT_TRUE(keptPlanUsed()) << "it did not move that far";
}

TEST_F(Place, AnArmThatMovedFarNeedsAnotherPlan) {
  takeIt();
  robot.joints[0] += 1.1 * ExecutionOptions().start_tolerance;
  robot.wait(0.01);
  const ActionResult result = place();
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_FALSE(keptPlanUsed());
  EXPECT_EQ(robot.sent.at(0).points.front().position[0], shown.at(0).points.front().position[0]);
}

TEST_F(Place, AWorldThatChangedNeedsAnotherPlan) {
  takeIt();
  const Trajectory carry = planned.at(planned.size() - 3);
  const Rigid3 half = executor->arm().baseFromTcp(carry.sample(carry.duration() / 2).position);
  PlacedObject obstacle = bridge(half.translation.x(), half.translation.y(), 7);
  obstacle.base_from_object.translation.z() = half.translation.z() - 0.08;
  executor->see({obstacle});
  const ActionResult result = place();
  ASSERT_FALSE(robot.sent.empty()) << result.reason;
  EXPECT_FALSE(keptPlanUsed());
}

TEST_F(Place, NoSuchPlace) {
  takeIt();
  const ActionResult result = place(-1);
  EXPECT_EQ(result.outcome, ActionOutcome::kUnreachable);
  EXPECT_THAT(result.reason, HasSubstr("there is no place -1"));
  EXPECT_EQ(executor->held(), "bridge 0");
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(Place, WhatWasNotPickedCannotBePlaced) {
  ActionResult result = place();
  EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost);
  EXPECT_EQ(result.reason, "the gripper holds nothing that was picked");

  robot.part_width = 0.03;
  robot.sendGripper(0);
  for (int i = 0; i < 100; ++i) robot.wait(0.01);
  result = place();
  EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost);
  EXPECT_EQ(result.reason,
            "the gripper holds nothing that was picked, and is not empty: recover() leads out");
}

TEST_F(Place, APlaceThatIsTaken) {
  takeIt();
  const DropPlace place_0 = executorOptions().drop_zone.places()[0];
  executor->see({bridge(place_0.x, place_0.y, 3)});
  const ActionResult result = place();
  EXPECT_EQ(result.outcome, ActionOutcome::kInCollision) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("bridge 3"));
  EXPECT_TRUE(robot.commands.empty());
  EXPECT_EQ(executor->held(), "bridge 0");
}

TEST_F(Place, CancelledInEveryStage) {
  for (const char* stage : {"plan", "carry", "lower", "open", "retreat"}) {
    SCOPED_TRACE(stage);
    beginAnew();
    takeIt();
    cancel_in = stage;
    const ActionResult result = place();
    cancel_in.clear();
    EXPECT_EQ(result.outcome, ActionOutcome::kCancelled) << result.reason;
    EXPECT_EQ(stages.back(), stage);
    EXPECT_TRUE(robot.stands());
    const bool let_go = stage == std::string("open") || stage == std::string("retreat");
    EXPECT_EQ(executor->held(), let_go ? "" : "bridge 0");
    EXPECT_EQ(memory.kept().has_value(), !let_go);
    const std::string last = robot.commands.empty() ? "" : robot.commands.back();
    const std::map<std::string, std::string> expected{
        {"plan", ""}, {"carry", "stop"}, {"lower", "stop"}, {"open", "gripper"}, {"retreat", "stop"}};
    EXPECT_EQ(last, expected.at(stage));
  }
}

TEST_F(Place, ACancelledCarryCanBeContinued) {
  takeIt();
  cancel_in = "carry";
  EXPECT_EQ(place().outcome, ActionOutcome::kCancelled);
  cancel_in.clear();
  const ActionResult result = place();
  EXPECT_TRUE(result.done()) << result.reason;
}

TEST_F(Place, LostWhileItIsCarried) {
  for (const char* stage : {"carry", "lower"}) {
    SCOPED_TRACE(stage);
    beginAnew();
    takeIt();
    dropAt(stage);
    const ActionResult result = place();
    EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost) << result.reason;
    EXPECT_THAT(result.reason, HasSubstr("the gripper lost bridge 0"));
    expectStopped(result);
    EXPECT_EQ(executor->held(), "");
  }
}

TEST_F(Place, LostBeforeItBegins) {
  takeIt();
  robot.part_width = 0;
  for (int i = 0; i < 100; ++i) robot.wait(0.01);
  const ActionResult result = place();
  EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost);
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(Place, FingersThatDoNotOpen) {
  takeIt();
  robot.widest_opening = 0.045;
  const ActionResult result = place();
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("something keeps the fingers from opening"));
  EXPECT_EQ(executor->held(), "bridge 0") << "nobody knows that it was let go";
}

TEST_F(Place, ASilentGripper) {
  options.execution.gripper_silence = 0.5;
  restart();
  executor->see({bridge()});
  takeIt();
  at("carry", [this] { robot.tells_gripper = false; });
  const ActionResult result = place();
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("gripper/state is silent"));
  expectStopped(result);
}

TEST_F(Place, SilentJointsWhileItIsCarried) {
  for (const char* stage : {"carry", "lower"}) {
    SCOPED_TRACE(stage);
    beginAnew();
    takeIt();
    at(stage, [this] { robot.tells_joints = false; });
    const ActionResult result = place();
    robot.tells_joints = true;
    EXPECT_EQ(result.outcome, ActionOutcome::kFault);
    EXPECT_THAT(result.reason, HasSubstr("joint_states is silent for"));
    EXPECT_EQ(robot.commands.back(), "stop");
    EXPECT_EQ(executor->held(), "bridge 0");
    EXPECT_TRUE(memory.kept()) << "a planner that starts again knows it";
  }
}

TEST_F(Place, SilentJointsAfterItIsPutDown) {
  takeIt();
  at("retreat", [this] { robot.tells_joints = false; });
  const ActionResult result = place();
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_EQ(robot.commands.back(), "stop");
  EXPECT_EQ(executor->held(), "");
  EXPECT_EQ(executor->scene().remembered(), 1u) << "it stands there";
}

TEST_F(Place, JointsThatAreSilentFromTheBeginning) {
  takeIt();
  robot.tells_joints = false;
  for (int i = 0; i < 500; ++i) robot.wait(0.01);
  EXPECT_THROW(place(), BadInput);
  EXPECT_TRUE(robot.commands.empty());
  EXPECT_EQ(executor->held(), "bridge 0");

  robot.tells_joints = true;
  robot.wait(0.01);
  EXPECT_TRUE(place().done());
}

TEST_F(Place, AnArmThatDoesNotStopWhenItIsTold) {
  for (const char* stage : {"carry", "lower", "retreat"}) {
    SCOPED_TRACE(stage);
    robot.stops = true;
    beginAnew();
    takeIt();
    robot.stops = false;
    cancel_in = stage;
    const ActionResult result = place();
    cancel_in.clear();
    EXPECT_EQ(result.outcome, ActionOutcome::kFault) << "a cancel would say that it stands";
    EXPECT_EQ(result.reason, "cancelled; the arm does not stop");
    EXPECT_EQ(robot.commands.back(), "stop");
    EXPECT_EQ(executor->held(), stage == std::string("retreat") ? "" : "bridge 0");
  }
}

TEST_F(Place, ALostPartAndAnArmThatDoesNotStop) {
  takeIt();
  robot.stops = false;
  dropAt("carry");
  const ActionResult result = place();
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("the gripper lost bridge 0"));
  EXPECT_THAT(result.reason, HasSubstr("the arm does not stop"));
}

TEST_F(Place, AfterARestartThePartIsKnown) {
  takeIt();
  restart();
  executor->see({});
  const ActionResult result = place();
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_THAT(log, ElementsAre("the gripper holds bridge 0, picked before this node started"));
  EXPECT_EQ(executor->scene().remembered(), 1u);
}

TEST_F(Place, AfterARestartWithAnEmptyHand) {
  takeIt();
  robot.part_width = 0;
  for (int i = 0; i < 100; ++i) robot.wait(0.01);
  restart();
  const ActionResult result = place();
  EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost);
  EXPECT_EQ(result.reason, "the gripper holds nothing that was picked");
}

TEST_F(Place, AMemoryOfAnotherRunIsNone) {
  takeIt();
  PickMemory later = *memory.kept();
  later.stamp = robot.clock() + 100;
  memory.keep(later);
  restart();
  EXPECT_EQ(place().outcome, ActionOutcome::kGraspLost);
  EXPECT_THAT(log, testing::IsEmpty());
}

}  // namespace
}  // namespace monocular_eye_hand
