#include "monocular_eye_hand/execution/held_part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

constexpr double kTolerance = 0.002;  // of the width [m]

/// gripper_tcp looking down.
Rigid3 tcpDown(double x, double y, double z) {
  Rigid3 pose;
  pose.rotation = Eigen::Vector3d(1, -1, -1).asDiagonal();
  pose.translation = {x, y, z};
  return pose;
}

HeldPart heldBridge() {
  PlacedObject object{"bridge", 3, {}};
  object.base_from_object.translation = {0.5, 0.1, 0.3};
  PickTarget target;
  target.base_from_grasp = tcpDown(0.5, 0.1, 0.35);
  return holdPart(object, target, 0.04);
}

GripperReading stalledAt(double width) {
  GripperReading reading;
  reading.width = width;
  reading.stalled = true;
  return reading;
}

TEST(HeldPart, StandsWhereItWasWhileTheHandIsWhereItTookIt) {
  const HeldPart held = heldBridge();
  const PlacedObject taken = held.inHand(tcpDown(0.5, 0.1, 0.35));
  EXPECT_EQ(taken.label(), "bridge 3");
  EXPECT_LT((taken.base_from_object.translation - held.object.base_from_object.translation).norm(), 1e-12);
  EXPECT_LT((taken.base_from_object.rotation - held.object.base_from_object.rotation).norm(), 1e-12);
}

TEST(HeldPart, GoesWithTheHand) {
  const PlacedObject lifted = heldBridge().inHand(tcpDown(0.6, 0.1, 0.55));
  EXPECT_LT((lifted.base_from_object.translation - Eigen::Vector3d(0.6, 0.1, 0.5)).norm(), 1e-12);

  Rigid3 turned = tcpDown(0.5, 0.1, 0.35);
  turned.rotation = expSO3({0, 0, M_PI / 2}) * turned.rotation;
  const PlacedObject also_turned = heldBridge().inHand(turned);
  EXPECT_LT((also_turned.base_from_object.rotation - expSO3({0, 0, M_PI / 2})).norm(), 1e-12);
}

TEST(HeldPart, IsHeldWhileItStallsTheFingersAtItsWidth) {
  const HeldPart held = heldBridge();
  EXPECT_EQ(held.lost(stalledAt(0.04), kTolerance), "");
  EXPECT_EQ(held.lost(stalledAt(0.04 + 0.9 * kTolerance), kTolerance), "");
  EXPECT_EQ(held.lost(stalledAt(0.04 - 0.9 * kTolerance), kTolerance), "");
}

TEST(HeldPart, IsLostWhenTheFingersMoveOrStandElsewhere) {
  const HeldPart held = heldBridge();
  EXPECT_EQ(held.lost(stalledAt(0.031), kTolerance),
            "the gripper lost bridge 3: it stands at 31 mm and held it at 40 mm");
  EXPECT_THAT(held.lost(stalledAt(0.04 + 1.1 * kTolerance), kTolerance), HasSubstr("lost bridge 3"));

  GripperReading moving = stalledAt(0.04);
  moving.stalled = false;
  EXPECT_THAT(held.lost(moving, kTolerance), HasSubstr("lost bridge 3"));
}

TEST(HeldPart, AnUnknownPartIsABoxAsWideAsTheFingersSay) {
  EXPECT_EQ(unknownPartSize(0.03).y(), 0.03);
  EXPECT_GT(unknownPartSize(0).y(), 0) << "a box needs a width";
}

/// As if it had stood on the table below the hand.
TEST(HeldPart, AnUnknownPartReachesToTheTable) {
  constexpr double kTable = 0.3;
  const HeldPart held = holdUnknownPart(tcpDown(0.5, 0.1, 0.8), kTable, 0.03, 0.06);
  EXPECT_EQ(held.object.name, kUnknownPart);
  EXPECT_EQ(held.target.object, held.object.label());
  EXPECT_EQ(held.width, 0.03);
  EXPECT_EQ(held.target.part_width, 0.03);
  EXPECT_EQ(held.target.opening, 0.06);

  const Eigen::Vector3d middle = held.object.base_from_object.translation;
  EXPECT_NEAR(middle.z() - unknownPartSize(0.03).z() / 2, kTable, 1e-12);
  EXPECT_NEAR(middle.x(), 0.5, 1e-12);
  EXPECT_NEAR(middle.y(), 0.1, 1e-12);

  // The hand is in the same place of the part, however high.
  const PlacedObject now = held.inHand(tcpDown(0.5, 0.1, 0.8));
  EXPECT_NEAR(now.base_from_object.translation.z() - middle.z(),
              0.8 - held.target.base_from_grasp.translation.z(), 1e-12);
}

}  // namespace
}  // namespace monocular_eye_hand
