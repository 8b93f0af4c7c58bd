#include "monocular_eye_hand/simulation/cell/work_cell.h"
#include "monocular_eye_hand/simulation/cell/scene.h"

#include <Eigen/Geometry>

#include "cell_world.h"

using namespace monocular_eye_hand;

namespace {

CellOptions oneBridge(double x = -0.05, double yaw = 0) {
  CellOptions options;
  options.objects.erase(options.objects.begin());
  options.objects.resize(1);
  options.objects[0].pose = {};
  options.objects[0].pose.x = x;
  options.objects[0].pose.yaw = yaw;
  options.start_joints = lookJoints();
  return options;
}

constexpr double kGrip = 0.045;  // height of the tcp when it grips the bridge's beam [m]
const Rigid3 kAbove = tableFromTcp(-0.05, 0, 0.16, M_PI / 2), kAt = tableFromTcp(-0.05, 0, kGrip, M_PI / 2);

/// Opens, comes from above, closes.
void grip(WorkCell* cell, double aside = 0) {
  Rigid3 above = kAbove, at = kAt;
  above.translation.y() += aside;
  at.translation.y() += aside;
  closeGripper(cell, 0.08);
  moveTo(cell, jointsFor(*cell, above));
  moveStraight(cell, above, at);
  closeGripper(cell, 0.01);
}

}  // namespace

TEST(Cell, HoldsCarriesAndSetsDown) {
  WorkCell cell = makeCell(oneBridge());
  grip(&cell);
  ASSERT_EQ(cell.heldObject(), 0) << eventsOf(cell);
  EXPECT_NEAR(cell.gripperWidth(), 0.040, 1e-5);
  EXPECT_TRUE(cell.gripperStalled());

  const Rigid3 tcp_from_object = cell.baseFromTcp().inverse() * cell.truth()[0].base_from_object;
  moveStraight(&cell, kAt, kAbove);
  const Rigid3 zone_above = tableFromTcp(-0.05, 0.33, 0.16, M_PI / 2);
  moveTo(&cell, jointsFor(cell, zone_above));
  EXPECT_LT(
      difference(tcp_from_object, cell.baseFromTcp().inverse() * cell.truth()[0].base_from_object).norm(),
      1e-9);
  EXPECT_TRUE(cell.truth()[0].held);
  EXPECT_FALSE(cell.inDropZone(0));

  closeGripper(&cell, 0.08);
  EXPECT_EQ(cell.heldObject(), -1);
  EXPECT_FALSE(cell.truth()[0].falling);
  EXPECT_TRUE(cell.inDropZone(0));
  EXPECT_NEAR(cell.truth()[0].base_from_object.translation.z(), 0.30, 1e-6);
  EXPECT_EQ(cell.collisions(), 0) << eventsOf(cell);
  ASSERT_EQ(cell.events().size(), 3u) << eventsOf(cell);
  EXPECT_EQ(cell.events()[0].kind, CellEvent::Kind::kGrasped);
  EXPECT_EQ(cell.events()[1].kind, CellEvent::Kind::kReleased);
  EXPECT_EQ(cell.events()[2].kind, CellEvent::Kind::kRested);
  EXPECT_EQ(cell.events()[2].second, "table");
  EXPECT_GT(cell.events()[2].time, cell.events()[1].time + 0.1);  // it fell 0.11 m
}

TEST(Cell, ClosingOnNothingReachesTheWidth) {
  WorkCell cell = makeCell(oneBridge(0.2));
  grip(&cell);
  EXPECT_EQ(cell.heldObject(), -1);
  EXPECT_NEAR(cell.gripperWidth(), 0.01, 1e-12);
  EXPECT_FALSE(cell.gripperStalled());
  EXPECT_TRUE(cell.events().empty()) << eventsOf(cell);
}

TEST(Cell, AFingerPushesThePartToTheMiddle) {
  WorkCell cell = makeCell(oneBridge());
  grip(&cell, 0.012);
  ASSERT_EQ(cell.heldObject(), 0) << eventsOf(cell);
  EXPECT_NEAR(cell.truth()[0].base_from_object.translation.y(), 0.012, 1e-4);
  EXPECT_EQ(cell.collisions(), 0) << eventsOf(cell);
}

TEST(Cell, AFixedPartIsNotPushedAndNotHeld) {
  CellOptions options = oneBridge();
  options.objects[0].fixed = true;
  WorkCell cell = makeCell(options);
  grip(&cell, 0.012);
  EXPECT_EQ(cell.heldObject(), -1);
  EXPECT_EQ(cell.truth()[0].base_from_object.translation.y(), 0);
  EXPECT_EQ(countOf(cell, CellEvent::Kind::kSlipped), 1) << eventsOf(cell);
}

TEST(Cell, ThePadsGiveWayALittleToAPartThatCannotMove) {
  CellOptions options = oneBridge();
  options.objects[0].fixed = true;
  for (const double aside : {0.0003, 0.002}) {
    WorkCell cell = makeCell(options);
    grip(&cell, aside);
    EXPECT_EQ(cell.heldObject(), aside < options.pad_compliance ? 0 : -1) << eventsOf(cell);
    EXPECT_TRUE(cell.gripperStalled());
    EXPECT_EQ(cell.collisions(), 0) << eventsOf(cell);
  }
}

TEST(Cell, EdgesBetweenThePadsAreNotHeld) {
  // A block turned by 45 degrees: the pads meet two opposite edges only.
  auto models = partMeshes();
  models.push_back({"block", std::make_shared<Mesh>(boxMesh({0.04, 0.04, 0.06}))});
  CellOptions options = oneBridge(-0.05, M_PI / 4);
  options.objects[0].name = "block";
  WorkCell cell(makeCellScene(options, models), pumaDescription());
  grip(&cell);
  EXPECT_EQ(cell.heldObject(), -1);
  EXPECT_EQ(countOf(cell, CellEvent::Kind::kSlipped), 1) << eventsOf(cell);
  moveStraight(&cell, kAt, kAbove);
  EXPECT_NEAR(cell.truth()[0].base_from_object.translation.z(), 0.30, 1e-9);  // stayed behind
  EXPECT_NEAR(cell.gripperWidth(), 0.01, 1e-12);                              // closed above it
}

TEST(Cell, TheHandInTheTableAndInAPartIsRecorded) {
  WorkCell cell = makeCell(oneBridge());
  const Rigid3 beside = tableFromTcp(0.15, 0, 0.1, 0), deep = tableFromTcp(0.15, 0, -0.01, 0);
  moveTo(&cell, jointsFor(cell, beside));
  EXPECT_EQ(cell.collisions(), 0) << eventsOf(cell);
  moveStraight(&cell, beside, deep);
  ASSERT_GE(cell.collisions(), 1);
  EXPECT_EQ(cell.events()[0].second, "table") << eventsOf(cell);
  EXPECT_EQ(cell.events()[0].first.substr(0, 6), "finger");

  const int before = cell.collisions();
  moveStraight(&cell, deep, beside);
  Rigid3 through = tableFromTcp(-0.05, 0, 0.05, 0), above = through;
  above.translation.z() = 0.2;
  moveTo(&cell, jointsFor(cell, above));
  EXPECT_EQ(cell.collisions(), before) << eventsOf(cell);
  moveStraight(&cell, above, through);  // the closed hand comes down on the bridge
  ASSERT_GT(cell.collisions(), before);
  EXPECT_EQ(cell.events().back().second, "bridge_0");
  EXPECT_EQ(cell.truth()[0].base_from_object.translation.z(), 0.30);
}

TEST(Cell, ACarriedPartThatMeetsAnotherIsRecorded) {
  CellOptions options = oneBridge();
  CellObject wall;
  wall.name = "grenade";
  wall.pose.x = 0.14;  // in the way of the bridge's end, which goes before the hand
  options.objects.push_back(wall);
  WorkCell cell = makeCell(options);
  grip(&cell);
  ASSERT_EQ(cell.heldObject(), 0);
  const Rigid3 lifted = tableFromTcp(-0.05, 0, kGrip + 0.02, M_PI / 2);
  moveStraight(&cell, kAt, lifted);
  EXPECT_EQ(cell.collisions(), 0) << eventsOf(cell);
  moveStraight(&cell, lifted, tableFromTcp(0.06, 0, kGrip + 0.02, M_PI / 2), 12);
  bool met = false;
  for (const CellEvent& e : cell.events())
    met = met || (e.kind == CellEvent::Kind::kCollision && e.first == "bridge_0" && e.second == "grenade_0");
  EXPECT_TRUE(met) << eventsOf(cell);
}

TEST(Cell, SameCommandsSameStates) {
  const auto run = [](double slice) {
    WorkCell cell = makeCell(oneBridge());
    cell.commandGripper(0.08);
    CellPathPoint goal;
    goal.time = 1.5;
    goal.positions = jointsFor(cell, kAt);
    cell.commandArm({goal});
    for (int k = 0; k < int(std::lround(2 / slice)); ++k) cell.advance(slice);
    closeGripper(&cell, 0.01);
    return std::make_pair(cell.truth()[0].base_from_object.translation, eventsOf(cell));
  };
  const auto a = run(0.01), b = run(0.01), c = run(0.5);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.second, b.second);
  EXPECT_EQ(a.first, c.first);
  EXPECT_EQ(a.second, c.second);
}

TEST(Cell, RefusesWhatItCannotDo) {
  WorkCell cell = makeCell(oneBridge());
  EXPECT_THROW(cell.commandGripper(0.2), BadInput);
  EXPECT_THROW(cell.commandGripper(-0.01), BadInput);
  EXPECT_THROW(cell.advance(-1), BadInput);
  CellOptions far = oneBridge();
  far.start_joints[0] = 6;
  EXPECT_THROW(makeCell(far), BadInput);
}

TEST(Cell, WhatIsTakenAwayIsNotThereAnyMore) {
  CellOptions options = oneBridge();
  options.objects.push_back(options.objects[0]);
  options.objects[1].pose.z = 0.055;  // on top of the other one
  WorkCell cell = makeCell(options);
  cell.takeAway("bridge_0");
  EXPECT_TRUE(cell.takenAway(0));
  EXPECT_FALSE(cell.takenAway(1));
  EXPECT_TRUE(cell.truth()[0].taken_away);
  EXPECT_EQ(cell.events().back().kind, CellEvent::Kind::kTakenAway);
  EXPECT_TRUE(cell.truth()[1].falling);

  cell.advance(1);
  EXPECT_FALSE(cell.truth()[1].falling);
  EXPECT_EQ(cell.events().back().second, "table") << eventsOf(cell);
  cell.takeAway("bridge_1");
  grip(&cell);
  EXPECT_EQ(cell.heldObject(), -1);
  EXPECT_FALSE(cell.gripperStalled());
  EXPECT_FALSE(cell.inDropZone(0));
  EXPECT_EQ(cell.collisions(), 0) << eventsOf(cell);
  EXPECT_THROW(cell.takeAway("bridge_0"), BadInput);
  EXPECT_THROW(cell.takeAway("bridge"), BadInput);
}

TEST(Cell, WhatIsTakenOutOfTheGripperLetsItClose) {
  WorkCell cell = makeCell(oneBridge());
  grip(&cell);
  ASSERT_EQ(cell.heldObject(), 0) << eventsOf(cell);
  cell.takeAway("bridge_0");
  EXPECT_EQ(cell.heldObject(), -1);
  EXPECT_FALSE(cell.truth()[0].held);
  EXPECT_TRUE(cell.gripperMoving());
  cell.advance(1);
  EXPECT_FALSE(cell.gripperStalled());
  EXPECT_NEAR(cell.gripperWidth(), 0.01, 1e-12);
}
