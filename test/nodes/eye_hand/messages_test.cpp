#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "monocular_eye_hand/geometry/error.h"
#include "node_messages.h"
#include "nodes/common/conversion.h"
#include "nodes/eye_hand/messages.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

RecognizedObject recognized(const std::string& name) {
  RecognizedObject object;
  object.name = name;
  object.pose = toPose(somePose(), someCovariance());
  object.probability = 0.8;
  return object;
}

std::string refusal(const RecognizedObject& object) {
  RecognizedObjectArray array;
  array.objects = {recognized("bridge"), object};
  try {
    toSeenObjects(array, twoObjects());
  } catch (const BadInput& e) {
    return e.what();
  }
  return "";
}

TEST(EyeHandConversion, TransformIsThePose) {
  const geometry_msgs::TransformStamped stamped = toTransform({}, "child", somePose());
  EXPECT_LT(difference(fromTransform(stamped.transform), somePose()).norm(), 1e-12);
}

TEST(EyeHandConversion, SeenObjectsCarryEverything) {
  RecognizedObjectArray array;
  array.objects = {recognized("frame"), recognized("bridge")};
  const std::vector<SeenObject> seen = toSeenObjects(array, twoObjects());
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].object, 1);
  EXPECT_EQ(seen[1].object, 0);
  for (const SeenObject& object : seen) {
    EXPECT_LT(difference(object.camera_from_object, somePose()).norm(), 1e-12);
    EXPECT_EQ(object.covariance, someCovariance());  // not its transpose, not in another order
    EXPECT_EQ(object.probability, 0.8);
  }
}

TEST(EyeHandConversion, BrokenObjectsAreRefusedByName) {
  EXPECT_EQ(refusal(recognized("frame")), "");
  EXPECT_THAT(refusal(recognized("spoon")), HasSubstr("'spoon' is not in the model base (bridge, frame)"));
  const auto changed = [](auto change) {
    RecognizedObject object = recognized("frame");
    change(&object);
    return refusal(object);
  };
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  using R = RecognizedObject;
  EXPECT_THAT(changed([&](R* o) { o->pose.pose.position.z = nan; }), HasSubstr("the pose of frame"));
  EXPECT_THAT(changed([&](R* o) { o->pose.pose.position.x = infinite; }), HasSubstr("the pose of frame"));
  EXPECT_THAT(changed([&](R* o) { o->pose.pose.orientation.x = nan; }), HasSubstr("orientation of frame"));
  EXPECT_THAT(changed([&](R* o) { o->pose.pose.orientation = geometry_msgs::Quaternion(); }),
              HasSubstr("has length 0, not 1"));
  EXPECT_THAT(changed([&](R* o) { o->pose.covariance[8] = nan; }), HasSubstr("the covariance of frame"));
  EXPECT_THAT(changed([&](R* o) { o->pose.covariance[1] = 1; }), HasSubstr("the covariance of frame"));
  EXPECT_THAT(changed([&](R* o) { o->pose.covariance[0] = -1; }), HasSubstr("the covariance of frame"));
}

TEST(EyeHandConversion, WhatWasCutShortIsNotComplete) {
  RecognizedObjectArray array;
  EXPECT_TRUE(isComplete(array));
  array.truncated = true;
  EXPECT_FALSE(isComplete(array));
  array.truncated = false;
  array.budget_spent = true;
  EXPECT_FALSE(isComplete(array));
}

MappedObject mapped() {
  MappedObject object;
  object.object = 0;
  object.name = "bridge";
  object.number = 3;
  object.base_from_object = somePose();
  object.covariance = someCovariance();
  object.free_axis = true;
  object.probability = 0.7;
  object.views = 4;
  object.misses = 1;
  return object;
}

TEST(EyeHandConversion, LocatedObjectCarriesEveryField) {
  const LocatedObject message = toMessage(mapped(), ros::Time(12, 34), "base");
  EXPECT_EQ(message.header.stamp, ros::Time(12, 34));
  EXPECT_EQ(message.header.frame_id, "base");
  EXPECT_EQ(message.name, "bridge");
  EXPECT_EQ(message.instance, 3);
  EXPECT_EQ(message.pose, toPose(somePose(), someCovariance()));
  EXPECT_EQ(message.probability, 0.7);
  EXPECT_TRUE(message.free_axis);
  EXPECT_EQ(message.views, 4);
  EXPECT_EQ(message.misses, 1);
}

TEST(EyeHandConversion, GraspTargetCarriesEveryField) {
  const LocatedObject object = toMessage(mapped(), ros::Time(12, 34), "base");
  GraspCandidate grasp;
  grasp.base_from_pregrasp = {expSO3({0.1, 0, 0}), {1, 2, 3}};
  grasp.base_from_grasp = {expSO3({0, 0.2, 0}), {4, 5, 6}};
  grasp.base_from_lift = {expSO3({0, 0, 0.3}), {7, 8, 9}};
  grasp.part_width = 0.03;
  grasp.opening = 0.05;
  grasp.approach = {0.6, 0, -0.8};
  grasp.branch = {Shoulder::kLeft, Elbow::kDown, Wrist::kNegative};
  grasp.pregrasp_joints << 1, 2, 3, 4, 5, 6;
  grasp.grasp_joints << 11, 12, 13, 14, 15, 16;
  grasp.lift_joints << 21, 22, 23, 24, 25, 26;
  grasp.free = 0.01;
  grasp.needed = 0.004;
  grasp.quality = 0.9;
  grasp.source = "faces 3 and 5";

  const GraspTarget target = toMessage(object, grasp);
  EXPECT_EQ(target.header, object.header);
  EXPECT_EQ(target.name, "bridge");
  EXPECT_EQ(target.instance, 3);
  EXPECT_EQ(target.object, object.pose);
  EXPECT_TRUE(target.feasible);
  EXPECT_EQ(target.reason, "faces 3 and 5");
  EXPECT_EQ(target.pregrasp, toPose(grasp.base_from_pregrasp));
  EXPECT_EQ(target.grasp, toPose(grasp.base_from_grasp));
  EXPECT_EQ(target.retreat, toPose(grasp.base_from_lift));
  EXPECT_EQ(target.approach.x, 0.6);
  EXPECT_EQ(target.approach.z, -0.8);
  EXPECT_EQ(target.width, 0.03);
  EXPECT_EQ(target.opening, 0.05);
  EXPECT_EQ(target.branch, "left-down-negative");
  EXPECT_THAT(target.pregrasp_joints, testing::ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(target.grasp_joints, testing::ElementsAre(11, 12, 13, 14, 15, 16));
  EXPECT_THAT(target.retreat_joints, testing::ElementsAre(21, 22, 23, 24, 25, 26));
  EXPECT_EQ(target.free, 0.01);
  EXPECT_EQ(target.needed, 0.004);
  EXPECT_EQ(target.quality, 0.9);
}

TEST(EyeHandConversion, NoGraspSaysWhy) {
  const LocatedObject object = toMessage(mapped(), ros::Time(12, 34), "base");
  const GraspTarget target = noGrasp(object, "too far");
  EXPECT_EQ(target.name, "bridge");
  EXPECT_EQ(target.instance, 3);
  EXPECT_EQ(target.object, object.pose);
  EXPECT_FALSE(target.feasible);
  EXPECT_EQ(target.reason, "too far");
}

using Response = GraspTargets::Response;
using visualization_msgs::Marker;

/// Two bridges, of which the second was seen last.
KnownObjects twoBridges() {
  KnownObjects known;
  known.stamp = 101000000007;
  known.map.stamp = secondsOf(known.stamp);
  for (int number = 0; number < 2; ++number) {
    MappedObject bridge;
    bridge.name = "bridge";
    bridge.number = number;
    known.map.objects.push_back(bridge);
    known.stamps.push_back((100 + number) * Nanoseconds(1000000000) + 7);
  }
  return known;
}

GraspCandidate grasp(double quality) {
  GraspCandidate grasp;
  grasp.quality = quality;
  grasp.source = "sampled";
  return grasp;
}

TEST(GraspMessages, FoundGraspsCarryTheObjectTheyAreOf) {
  GraspAnswer answer;
  answer.status = GraspStatus::kFound;
  answer.text = "bridge 1: 2 grasps";
  answer.index = 1;
  answer.candidates = {grasp(0.9), grasp(0.5)};
  const Response response = toMessage(answer, twoBridges(), "base_link");
  EXPECT_EQ(response.status, Response::FOUND);
  EXPECT_EQ(response.text, answer.text);
  ASSERT_EQ(response.targets.size(), 2u);
  for (const GraspTarget& target : response.targets) {
    EXPECT_TRUE(target.feasible);
    EXPECT_EQ(target.instance, 1);
    EXPECT_EQ(target.header.stamp, ros::Time(101, 7));
  }
  EXPECT_EQ(response.targets[0].quality, 0.9);
}

TEST(GraspMessages, EveryStatusHasItsCode) {
  const auto code = [](GraspStatus status) {
    GraspAnswer answer;
    answer.status = status;
    answer.text = "why";
    const Response response = toMessage(answer, twoBridges(), "base_link");
    EXPECT_EQ(response.text, "why");
    EXPECT_TRUE(response.targets.empty());
    return response.status;
  };
  EXPECT_EQ(code(GraspStatus::kUnknownName), Response::UNKNOWN_NAME);
  EXPECT_EQ(code(GraspStatus::kNotReady), Response::NOT_READY);
  EXPECT_EQ(code(GraspStatus::kNotKnown), Response::NOT_KNOWN);
  EXPECT_EQ(code(GraspStatus::kNoGrasp), Response::NO_GRASP);
  EXPECT_EQ(code(GraspStatus::kTooUncertain), Response::TOO_UNCERTAIN);
}

TEST(GraspMessages, BestOfEachOrWhyThereIsNone) {
  const GraspTargetArray array =
      toMessage({{0, grasp(0.7), ""}, {1, std::nullopt, "the table"}}, twoBridges(), "base_link");
  EXPECT_EQ(array.header.stamp, ros::Time(101, 7));
  EXPECT_EQ(array.header.frame_id, "base_link");
  ASSERT_EQ(array.targets.size(), 2u);
  EXPECT_TRUE(array.targets[0].feasible);
  EXPECT_EQ(array.targets[0].header.stamp, ros::Time(100, 7));
  EXPECT_FALSE(array.targets[1].feasible);
  EXPECT_EQ(array.targets[1].reason, "the table");
}

TEST(GraspArrowsTest, AppearAndGo) {
  GraspTargetArray grasps;
  grasps.header.frame_id = "base_link";
  grasps.targets.resize(2);
  grasps.targets[0].name = "bridge";
  grasps.targets[0].instance = 4;
  grasps.targets[0].feasible = true;
  grasps.targets[0].pregrasp.position.z = 1;
  grasps.targets[0].grasp.position.z = 0.9;
  grasps.targets[1].name = "grenade";
  GraspArrows arrows;
  visualization_msgs::MarkerArray array = arrows.build(grasps);
  ASSERT_EQ(array.markers.size(), 1u);  // what cannot be grasped has none
  EXPECT_EQ(array.markers[0].type, Marker::ARROW);
  EXPECT_EQ(array.markers[0].ns, "bridge/grasp");
  EXPECT_EQ(array.markers[0].id, 4);
  EXPECT_EQ(array.markers[0].header.frame_id, "base_link");
  ASSERT_EQ(array.markers[0].points.size(), 2u);
  EXPECT_EQ(array.markers[0].points[0].z, 1);
  EXPECT_EQ(array.markers[0].points[1].z, 0.9);
  grasps.targets[0].feasible = false;
  array = arrows.build(grasps);
  ASSERT_EQ(array.markers.size(), 1u);
  EXPECT_EQ(array.markers[0].action, Marker::DELETE);
  EXPECT_EQ(array.markers[0].ns, "bridge/grasp");
  EXPECT_EQ(array.markers[0].id, 4);
  EXPECT_TRUE(arrows.build(grasps).markers.empty());
}

}  // namespace
}  // namespace monocular_eye_hand
