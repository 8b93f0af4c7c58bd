#include <gtest/gtest.h>

#include "nodes/planner/memory.h"

namespace monocular_eye_hand {
namespace {

Rigid3 pose(double angle) {
  return {Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
          {angle, 1, -angle}};
}

PickMemory memory() {
  PickMemory memory;
  memory.object = {"bridge", 2, pose(0.3)};
  memory.target.object = "bridge 2";
  memory.target.base_from_pregrasp = pose(0.5);
  memory.target.base_from_grasp = pose(0.7);
  memory.target.base_from_lift = pose(0.9);
  memory.target.opening = 0.07;
  memory.target.part_width = 0.04;
  memory.stamp = 12.5;
  return memory;
}

bool same(const Rigid3& a, const Rigid3& b) {
  return a.rotation == b.rotation && a.translation == b.translation;
}

TEST(PlannerMemory, ComesBackAsItWas) {
  const PickMemory before = memory();
  const std::optional<PickMemory> after = fromParameter(toParameter(before));
  ASSERT_TRUE(after);
  EXPECT_EQ(after->object.label(), "bridge 2");
  EXPECT_EQ(after->target.object, "bridge 2");
  EXPECT_TRUE(same(after->object.base_from_object, before.object.base_from_object));
  EXPECT_TRUE(same(after->target.base_from_pregrasp, before.target.base_from_pregrasp));
  EXPECT_TRUE(same(after->target.base_from_grasp, before.target.base_from_grasp));
  EXPECT_TRUE(same(after->target.base_from_lift, before.target.base_from_lift));
  EXPECT_EQ(after->target.opening, 0.07);
  EXPECT_EQ(after->target.part_width, 0.04);
  EXPECT_EQ(after->stamp, 12.5);
}

TEST(PlannerMemory, WhatOthersWroteIsNoMemory) {
  EXPECT_FALSE(fromParameter(XmlRpc::XmlRpcValue()));
  EXPECT_FALSE(fromParameter(XmlRpc::XmlRpcValue("bridge")));
  for (const char* key : {"name", "instance", "base_from_object", "grip_width", "stamp"}) {
    XmlRpc::XmlRpcValue value = toParameter(memory());
    value[key] = XmlRpc::XmlRpcValue(true);
    EXPECT_FALSE(fromParameter(value)) << key;
  }
}

TEST(PlannerMemory, APoseThatIsNoneIsNoMemory) {
  XmlRpc::XmlRpcValue value = toParameter(memory());
  value["base_from_object"][0] = 5.0;
  EXPECT_FALSE(fromParameter(value));
}

}  // namespace
}  // namespace monocular_eye_hand
