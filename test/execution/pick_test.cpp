#include "executor_world.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Pick : public ExecutorTest {};

TEST_F(Pick, TakesAnObject) {
  const ActionResult result = pick();
  ASSERT_TRUE(result.done()) << result.reason;
  EXPECT_THAT(stages, ElementsAre("plan", "reach", "approach", "close", "lift"));
  EXPECT_EQ(executor->held(), "bridge 0");
  EXPECT_TRUE(tcpIsAt(pickOrder(bridge()).target.base_from_lift));
  EXPECT_EQ(robot.sent_stops, 0);
  EXPECT_EQ(shown.size(), 6u) << "the whole way, to its place";
  EXPECT_GT(result.planning_time, 0);
  EXPECT_GT(result.motion_time, 1);
  EXPECT_EQ(result.stamp, robot.state().joints->stamp);
  ASSERT_TRUE(memory.kept());
  EXPECT_EQ(memory.kept()->object.label(), "bridge 0");
}

TEST_F(Pick, TheMemoryIsKeptBeforeTheFingersClose) {
  bool kept_before = false;
  at("close", [&] { kept_before = memory.kept().has_value() && robot.sent_widths.size() <= 2; });
  EXPECT_TRUE(pick().done());
  EXPECT_TRUE(kept_before);
}

TEST_F(Pick, RefusesBeforeAnythingMoves) {
  PickOrder order = pickOrder(bridge());
  order.object.name = "teapot";
  ActionResult result = pick(order);
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("bad goal: no object is named 'teapot'; known: "));

  result = pick(99);
  EXPECT_EQ(result.outcome, ActionOutcome::kUnreachable);
  EXPECT_EQ(result.reason, "there is no place 99: the drop zone has 6, counted from 0");

  restart();
  result = pick();
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("nothing came on see() yet"));
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(Pick, Unreachable) {
  const PlacedObject far = bridge(1.6, 0);
  executor->see({far});
  const ActionResult result = pick(pickOrder(far));
  EXPECT_EQ(result.outcome, ActionOutcome::kUnreachable) << result.reason;
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(Pick, InCollision) {
  executor->see({bridge(), bridge(0.5, 0.055, 1)});  // no room for the finger between them
  const ActionResult result = pick();
  EXPECT_EQ(result.outcome, ActionOutcome::kInCollision) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("bridge 1"));
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(Pick, CancelledInEveryStage) {
  for (const char* stage : {"plan", "reach", "approach", "close", "lift"}) {
    SCOPED_TRACE(stage);
    restart();
    memory.keep(std::nullopt);
    executor->see({bridge()});
    robot.part_width = 0;
    robot.sendGripper(0.05);
    for (int i = 0; i < 100; ++i) robot.wait(0.01);
    robot.commands.clear();
    cancel_in = stage;
    const ActionResult result = pick();
    EXPECT_EQ(result.outcome, ActionOutcome::kCancelled) << result.reason;
    EXPECT_EQ(stages.back(), stage);
    EXPECT_TRUE(robot.stands());
    const bool holds = stage == std::string("close") || stage == std::string("lift");
    EXPECT_EQ(executor->held(), holds ? "bridge 0" : "");
    const std::string last = robot.commands.empty() ? "" : robot.commands.back();
    const std::map<std::string, std::string> expected{
        {"plan", ""}, {"reach", "gripper"}, {"approach", "stop"}, {"close", "gripper"}, {"lift", "stop"}};
    EXPECT_EQ(last, expected.at(stage));
    cancel_in.clear();
  }
}

TEST_F(Pick, NothingBetweenTheFingers) {
  at("approach", [this] { robot.part_width = 0; });
  const ActionResult result = pick();
  EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost);
  EXPECT_THAT(result.reason, HasSubstr("the gripper closed to 30 mm and bridge 0 is 40 mm wide there"));
  EXPECT_EQ(executor->held(), "");
  EXPECT_FALSE(memory.kept());
}

TEST_F(Pick, SomethingElseBetweenTheFingers) {
  at("approach", [this] { robot.part_width = 0.055; });
  const ActionResult result = pick();
  EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost);
  EXPECT_THAT(result.reason, HasSubstr("the gripper closed to 55 mm (stalled)"));
}

TEST_F(Pick, LostInTheLift) {
  dropAt("lift");
  const ActionResult result = pick();
  EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost);
  EXPECT_THAT(result.reason, HasSubstr("the gripper lost bridge 0"));
  expectStopped(result);
  EXPECT_EQ(executor->held(), "");
  EXPECT_FALSE(memory.kept());
}

TEST_F(Pick, FingersThatDoNotOpen) {
  robot.widest_opening = 0.055;
  const ActionResult result = pick();
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("something keeps the fingers from opening"));
  EXPECT_TRUE(robot.sent.empty());
}

TEST_F(Pick, FingersThatDoNotClose) {
  at("close", [this] { robot.tells_gripper = false; });
  const ActionResult result = pick();
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("gripper/state is silent"));
  EXPECT_TRUE(memory.kept()) << "the fingers may have closed";
}

TEST_F(Pick, SilentJoints) {
  at("reach", [this] { robot.tells_joints = false; });
  const ActionResult result = pick();
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("joint_states is silent"));
  EXPECT_EQ(robot.commands.back(), "stop");
}

TEST_F(Pick, SilentBeforeItBegins) {
  robot.tells_joints = false;
  for (int i = 0; i < 300; ++i) robot.wait(0.01);
  EXPECT_THROW(pick(), BadInput);
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(Pick, AnArmThatDoesNotStop) {
  robot.stops = false;
  cancel_in = "approach";
  const ActionResult result = pick();
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_EQ(result.reason, "cancelled; the arm does not stop");
}

TEST_F(Pick, TwoAreTooMany) {
  ASSERT_TRUE(pick().done());
  const size_t commands = robot.commands.size();
  const ActionResult result = pick(pickOrder(bridge(0.6, -0.2, 1)));
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_EQ(result.reason, "the gripper holds bridge 0: place it first; recover() leads out");
  EXPECT_EQ(robot.commands.size(), commands);
}

}  // namespace
}  // namespace monocular_eye_hand
