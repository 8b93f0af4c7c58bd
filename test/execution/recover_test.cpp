#include "executor_world.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Recover : public ExecutorTest {
 protected:
  /// What nobody picked is between the fingers.
  void giveUnknownPart() {
    robot.part_width = 0.03;
    robot.sendGripper(0);
    for (int i = 0; i < 100; ++i) robot.wait(0.01);
    robot.commands.clear();
  }
  /// The fingers stand in something that is known wrongly.
  void standInABridge() {
    ASSERT_TRUE(move(moveTo(down(0.5, 0, 0.48))).done());
    PlacedObject around = bridge();
    around.base_from_object.translation += Eigen::Vector3d(0, 0.025, 0.13);
    executor->see({around});
    robot.commands.clear();
  }
};

TEST_F(Recover, AFreeHandIsOpened) {
  const ActionResult result = recover();
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_EQ(result.reason, "opened the gripper");
  EXPECT_THAT(robot.commands, ElementsAre("gripper"));
  EXPECT_NEAR(robot.width, executor->description().gripper_width_max, 1e-6);

  robot.commands.clear();
  EXPECT_TRUE(recover().done());
  EXPECT_TRUE(robot.commands.empty()) << "it is open";
}

TEST_F(Recover, BacksOff) {
  standInABridge();
  const ActionResult result = recover();
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("backed off by "));
  EXPECT_THAT(stages, testing::Contains("withdraw"));
  EXPECT_TRUE(move(moveTo(down(0.45, -0.25, 0.6))).done());
}

TEST_F(Recover, PutsDownWhatItHolds) {
  ASSERT_TRUE(pick().done());
  const ActionResult result = recover();
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_EQ(result.reason, "put down bridge 0 at place 0; opened the gripper");
  EXPECT_EQ(executor->held(), "");
  EXPECT_FALSE(memory.kept());
  EXPECT_EQ(executor->scene().remembered(), 1u);
}

TEST_F(Recover, PutsDownWhereNothingStands) {
  ASSERT_TRUE(pick().done());
  const DropPlace taken = executorOptions().drop_zone.places()[0];
  executor->see({bridge(taken.x, taken.y, 4)});
  const ActionResult result = recover();
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("put down bridge 0 at place "));
  EXPECT_THAT(result.reason, testing::Not(HasSubstr("at place 0;")));
}

TEST_F(Recover, AnUnknownPart) {
  giveUnknownPart();
  const ActionResult result = recover();
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_EQ(result.reason, "put down unknown part 0 at place 0; opened the gripper");
  EXPECT_EQ(executor->held(), "");
  EXPECT_TRUE(robot.stands());
}

TEST_F(Recover, AfterARestart) {
  ASSERT_TRUE(pick().done());
  restart();
  executor->see({});
  const ActionResult result = recover();
  EXPECT_TRUE(result.done()) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("put down bridge 0"));
}

TEST_F(Recover, NoFreePlace) {
  ASSERT_TRUE(pick().done());
  std::vector<PlacedObject> all;
  for (const DropPlace& place : executorOptions().drop_zone.places())
    all.push_back(bridge(place.x, place.y, 10 + int(all.size())));
  executor->see(all);
  robot.commands.clear();
  const ActionResult result = recover();
  EXPECT_EQ(result.outcome, ActionOutcome::kUnreachable) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("no free place for bridge 0 can be reached: place 5"));
  EXPECT_EQ(executor->held(), "bridge 0");
}

TEST_F(Recover, Cancelled) {
  ASSERT_TRUE(pick().done());
  for (const char* stage : {"plan", "carry", "lower"}) {
    SCOPED_TRACE(stage);
    cancel_in = stage;
    const ActionResult result = recover();
    EXPECT_EQ(result.outcome, ActionOutcome::kCancelled) << result.reason;
    EXPECT_TRUE(robot.stands());
    EXPECT_EQ(executor->held(), "bridge 0");
  }
  cancel_in = "open";
  EXPECT_EQ(recover().outcome, ActionOutcome::kCancelled);
  EXPECT_EQ(executor->held(), "");
}

TEST_F(Recover, CancelledWhileItBacksOff) {
  standInABridge();
  cancel_in = "withdraw";
  const ActionResult result = recover();
  EXPECT_EQ(result.outcome, ActionOutcome::kCancelled) << result.reason;
  expectStopped(result);
}

TEST_F(Recover, LostWhileItIsCarried) {
  ASSERT_TRUE(pick().done());
  dropAt("carry");
  const ActionResult result = recover();
  EXPECT_EQ(result.outcome, ActionOutcome::kGraspLost) << result.reason;
  expectStopped(result);
}

TEST_F(Recover, FingersThatDoNotOpen) {
  robot.widest_opening = 0.052;
  const ActionResult result = recover();
  EXPECT_EQ(result.outcome, ActionOutcome::kFault);
  EXPECT_THAT(result.reason, HasSubstr("something keeps the fingers from opening"));
}

TEST_F(Recover, NoWayOut) {
  CellBox lid;  // around the hand, whose fingers stand in the table
  lid.name = "lid";
  lid.x = 0.5;
  lid.y = -0.1;
  lid.z = kTableTop + 0.12;
  lid.size = {{1, 1, 0.02}};
  options.boxes = {lid};
  restart();
  standAt(down(lid.x, lid.y, kTableTop + 0.005));
  const ActionResult result = recover();
  EXPECT_EQ(result.outcome, ActionOutcome::kInCollision) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("; move the arm away by hand"));
  EXPECT_TRUE(robot.commands.empty());
}

}  // namespace
}  // namespace monocular_eye_hand
