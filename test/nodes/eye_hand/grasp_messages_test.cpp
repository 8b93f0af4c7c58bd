#include "nodes/eye_hand/grasp_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nodes/eye_hand/conversion.h"
#include "nodes/eye_hand/grasp_arrows.h"

namespace monocular_eye_hand {
namespace {

using Response = GraspTargets::Response;
using visualization_msgs::Marker;

/// Two bridges, of which the second was seen last.
KnownObjects twoBridges() {
  KnownObjects known;
  known.stamp = ros::Time(101, 7);
  known.map.stamp = known.stamp.toSec();
  for (int number = 0; number < 2; ++number) {
    MappedObject bridge;
    bridge.name = "bridge";
    bridge.number = number;
    known.map.objects.push_back(bridge);
    known.messages.push_back(toMessage(bridge, ros::Time(100 + number, 7), "base_link"));
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
  const Response response = toMessage(answer, twoBridges());
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
    const Response response = toMessage(answer, twoBridges());
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
