#include "executor_world.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const Rigid3 kAside = down(0.45, -0.25, 0.6);

class Move : public ExecutorTest {};

TEST_F(Move, GoesThere) {
  const ActionResult result = move(moveTo(kAside));
  ASSERT_TRUE(result.done()) << result.reason;
  EXPECT_TRUE(tcpIsAt(kAside));
  EXPECT_EQ(result.reached, 0);
  EXPECT_EQ(result.stamp, robot.state().joints->stamp);
  EXPECT_THAT(stages, ElementsAre("plan", "move"));
  EXPECT_EQ(robot.sent_stops, 0);
}

TEST_F(Move, TheFirstThatCanBeReached) {
  MoveOrder order = moveTo(down(3, 0, 0.6));
  order.base_from_tcp.push_back(kAside);
  const ActionResult result = move(order);
  ASSERT_TRUE(result.done()) << result.reason;
  EXPECT_EQ(result.reached, 1);
}

TEST_F(Move, WhoIsThereStays) {
  MoveOrder order;
  order.joints = {robot.joints};
  const ActionResult result = move(order);
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_EQ(result.reached, 0);
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(Move, OpensFirst) {
  MoveOrder order = moveTo(kAside);
  order.open_gripper = true;
  const ActionResult result = move(order);
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_EQ(robot.commands.front(), "gripper");
  EXPECT_THAT(stages, ElementsAre("plan", "open", "move"));
  EXPECT_NEAR(robot.width, executor->description().gripper_width_max, 1e-6);
}

TEST_F(Move, Unreachable) {
  const ActionResult result = move(moveTo(down(3, 0, 0.6)));
  EXPECT_EQ(result.outcome, ActionOutcome::kUnreachable) << result.reason;
  EXPECT_EQ(result.reached, -1);
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(Move, InCollision) {
  const ActionResult result = move(moveTo(down(0.5, 0.1, kTableTop - 0.05)));
  EXPECT_EQ(result.outcome, ActionOutcome::kInCollision) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("table"));
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(Move, AStartInCollisionSaysTheWayOut) {
  ASSERT_TRUE(move(moveTo(down(0.5, 0, 0.48))).done());
  PlacedObject around = bridge();
  around.base_from_object.translation += Eigen::Vector3d(0, 0.025, 0.13);  // known wrongly: in a finger
  executor->see({around});
  robot.commands.clear();
  const ActionResult result = move(moveTo(kAside));
  EXPECT_EQ(result.outcome, ActionOutcome::kInCollision) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("; recover() leads out"));
  EXPECT_TRUE(robot.commands.empty());
}

TEST_F(Move, Cancelled) {
  for (const char* stage : {"plan", "open", "move"}) {
    SCOPED_TRACE(stage);
    robot.commands.clear();
    MoveOrder order = moveTo(kAside);
    order.open_gripper = stage == std::string("open");
    cancel_in = stage;
    const ActionResult result = move(order);
    EXPECT_EQ(result.outcome, ActionOutcome::kCancelled) << result.reason;
    EXPECT_EQ(stages.back(), stage);
    EXPECT_TRUE(robot.stands());
    const std::string last = robot.commands.empty() ? "" : robot.commands.back();
    const std::map<std::string, std::string> expected{{"plan", ""}, {"open", "gripper"}, {"move", "stop"}};
    EXPECT_EQ(last, expected.at(stage));
  }
}

TEST_F(Move, Faults) {
  at("move", [this] { robot.tells_joints = false; });
  ActionResult result = move(moveTo(kAside));
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("joint_states is silent"));
  EXPECT_EQ(robot.commands.back(), "stop");
}

TEST_F(Move, WithThePart) {
  ASSERT_TRUE(pick().done());
  const ActionResult result = move(moveTo(kAside));
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_EQ(executor->held(), "bridge 0");
  EXPECT_TRUE(place().done()) << "by a plan from here";
}

TEST_F(Move, ThePartIsLost) {
  ASSERT_TRUE(pick().done());
  dropAt("move");
  const ActionResult result = move(moveTo(kAside));
  EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost) << result.reason;
  expectStopped(result);
  EXPECT_EQ(executor->held(), "");
}

TEST_F(Move, OpeningLetsThePartFall) {
  ASSERT_TRUE(pick().done());
  MoveOrder order = moveTo(kAside);
  order.open_gripper = true;
  robot.part_width = 0;
  robot.sendGripper(kBridgeWidth - 0.01);
  const ActionResult result = move(order);
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_EQ(executor->held(), "");
  EXPECT_FALSE(memory.kept());
}

}  // namespace
}  // namespace monocular_eye_hand
