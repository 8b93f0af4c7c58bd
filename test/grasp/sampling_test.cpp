#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "grasp_world.h"
#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/grasp/model_grasps.h"
#include "monocular_eye_hand/mesh/ray_scene.h"
#include "monocular_eye_hand/options/options.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using namespace grasp_world;
using testing::HasSubstr;

// Every grasp must hold from outside on both sides at its width, and its quality lie in order.
void expectSound(const ObjectModel& model, const ModelGrasps& found, const GripperOptions& gripper = {}) {
  double last = 1;
  for (const ModelGrasp& g : found.grasps) {
    EXPECT_LE(g.quality, last + 1e-9);
    last = g.quality;
    EXPECT_GT(g.quality, 0);
    EXPECT_LE(g.quality, 1);
    EXPECT_GE(g.contact, GraspSamplingOptions().min_contact);
    EXPECT_LE(g.width, gripper.opening_max);
    const Eigen::Matrix3d r = g.object_from_tcp.rotation;
    EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    EXPECT_NEAR(r.determinant(), 1, 1e-9);
    for (const double side : {1.0, -1.0}) {  // no material outside the pads where the fingers close
      const Eigen::Vector3d outside = g.object_from_tcp * Eigen::Vector3d(0, side * 0.2, 0);
      const Eigen::Vector3d at_pad = g.object_from_tcp * Eigen::Vector3d(0, side * (g.width / 2 + 1e-3), 0);
      const Eigen::Vector3d fingers = g.object_from_tcp * Eigen::Vector3d(0, side * (g.width / 2 + 8e-3), 0);
      EXPECT_FALSE(model.rays->occluded(fingers, at_pad)) << g.source << ' ' << outside.transpose();
    }
  }
}

TEST(Sampling, BoxIsHeldByItsTwoNarrowPairs) {
  const ObjectModel model = boxModel(0.15, 0.04, 0.06);
  const ModelGrasps found = sampleGrasps(model, {});
  ASSERT_FALSE(found.grasps.empty()) << found.reason;
  expectSound(model, found);
  bool across_y = false, across_z = false;
  for (const ModelGrasp& g : found.grasps) {
    const Eigen::Vector3d closing = g.object_from_tcp.rotation.col(1).cwiseAbs();
    EXPECT_LT(closing.x(), 1e-6) << "150 mm do not fit";
    across_y |= closing.y() > 0.999 && std::abs(g.width - 0.04) < 1e-9;
    across_z |= closing.z() > 0.999 && std::abs(g.width - 0.06) < 1e-9;
  }
  EXPECT_TRUE(across_y);
  EXPECT_TRUE(across_z);
  const ModelGrasp& best = found.grasps.front();
  EXPECT_GT(best.contact, 0.99);
  EXPECT_LT(best.lever, 0.03);
}

TEST(Sampling, CylinderIsHeldAcrossItsAxis) {
  const ObjectModel model = buildModel("rod", cylinder(0.02, 0.08));
  const ModelGrasps found = sampleGrasps(model, {});
  ASSERT_FALSE(found.grasps.empty()) << found.reason;
  expectSound(model, found);
  bool along = false, across = false;
  for (const ModelGrasp& g : found.grasps) {
    if (g.source.find("cylinder") == std::string::npos) continue;
    EXPECT_NEAR(g.object_from_tcp.rotation(2, 1), 0, 1e-6);
    EXPECT_LT(g.object_from_tcp.translation.head<2>().norm(), 1e-4);
    along |= std::abs(g.object_from_tcp.rotation(2, 2)) > 0.999;
    across |= std::abs(g.object_from_tcp.rotation(2, 2)) < 0.001;
  }
  EXPECT_TRUE(along);
  EXPECT_TRUE(across);
}

TEST(Sampling, ShippedPartsHaveGrasps) {
  for (const char* name : {"bridge", "grenade", "flange", "bracket"}) {
    const ObjectModel model = shipped(name);
    const ModelGrasps found = sampleGrasps(model, {});
    EXPECT_FALSE(found.grasps.empty()) << found.reason;
    EXPECT_GT(found.grasps.front().quality, 0.3) << name;
    expectSound(model, found);
    RecordProperty(std::string(name) + "_grasps", int(found.grasps.size()));
  }
}

TEST(Sampling, SymmetricCopiesAreLeftOut) {
  const ObjectModel model = boxModel(0.15, 0.04, 0.06);
  ObjectModel plain = model;
  plain.symmetries = {};
  const size_t modulo = sampleGrasps(model, {}).grasps.size(), all = sampleGrasps(plain, {}).grasps.size();
  EXPECT_LT(modulo, all);
  EXPECT_GE(4 * modulo, all);  // the box has four rotations
}

TEST(Sampling, IsDeterministic) {
  const ObjectModel model = shipped("bracket");
  const ModelGrasps a = sampleGrasps(model, {}), b = sampleGrasps(model, {});
  ASSERT_EQ(a.grasps.size(), b.grasps.size());
  for (size_t k = 0; k < a.grasps.size(); ++k) {
    EXPECT_EQ(a.grasps[k].object_from_tcp.translation, b.grasps[k].object_from_tcp.translation);
    EXPECT_EQ(a.grasps[k].quality, b.grasps[k].quality);
  }
}

TEST(Sampling, NothingFoundHasAReason) {
  const ModelGrasps found = sampleGrasps(boxModel(0.2, 0.2, 0.2), {});
  EXPECT_TRUE(found.grasps.empty());
  EXPECT_THAT(found.reason, HasSubstr("no parallel faces and no outer cylinder between 0 and 86 mm"));
  GripperOptions deep;  // fingers so short that the hand always meets the part
  deep.finger_length = 0.009;
  deep.body = {{{{0, 0, -0.02}}, {{0.3, 0.3, 0.02}}}};
  GraspSamplingOptions all_of_it;
  all_of_it.min_contact = 1;
  deep.pad_length = 0.017;
  deep.finger_tip = 0.0085;
  EXPECT_THAT(sampleGrasps(boxModel(0.15, 0.04, 0.012), deep, all_of_it).reason, HasSubstr("box"));
}

TEST(Sampling, GivenGraspsAreCheckedAndTurned) {
  KnownObject object{boxModel(0.06, 0.04, 0.06), {}, {}};
  GivenGrasp given;
  given.object_from_tcp.rotation.diagonal() << 1, -1, -1;  // from above
  given.object_from_tcp.translation.z() = 0.05;
  given.width = 0.04;
  given.rotation_steps = 2;
  object.handling.grasps = {given};
  ModelGrasps found = graspsOf(object, {});
  ASSERT_EQ(found.grasps.size(), 2u) << found.reason;
  EXPECT_EQ(found.grasps[0].source, "given 0");
  EXPECT_GT(found.grasps[0].contact, 0.9);

  object.handling.grasps[0].rotation_steps = 4;  // two of them close on 60 mm
  found = graspsOf(object, {});
  EXPECT_EQ(found.grasps.size(), 2u);
  EXPECT_THAT(found.reason, HasSubstr("given 0, turn 1: the pads touch with less"));
  object.handling.grasps[0].width = 0.2;
  found = graspsOf(object, {});
  EXPECT_TRUE(found.grasps.empty());
  EXPECT_THAT(found.reason, HasSubstr("width 200 mm does not fit the opening of 0 to 90 mm"));

  object.handling.grasps[0].width = 0.04;
  object.handling.grasps[0].object_from_tcp.translation.z() = 0.0;  // the rail would be inside the box
  found = graspsOf(object, {});
  EXPECT_TRUE(found.grasps.empty());
  EXPECT_THAT(found.reason, HasSubstr("given 0"));
}

TEST(Sampling, WhatMustNotBeGraspedIsNot) {
  KnownObject frame{shipped("frame"), {}, {}};
  frame.handling.obstacle = true;
  EXPECT_THAT(graspsOf(frame, {}).reason, HasSubstr("frame is an obstacle"));
  EXPECT_TRUE(graspsOf(frame, {}).grasps.empty());
  KnownObject box{boxModel(0.15, 0.04, 0.06), {}, {}};
  box.handling.grasp = false;
  EXPECT_THAT(graspsOf(box, {}).reason, HasSubstr("must not be grasped"));
}

TEST(Sampling, CentreOfMass) {
  EXPECT_LT((centreOfMass(boxModel(0.1, 0.1, 0.04)) - Eigen::Vector3d(0, 0, 0.02)).norm(), 1e-9);
  const ObjectModel bridge = shipped("bridge");
  // Block of 120 x 40 x 60 mm less an opening of 60 x 40 x 38 mm.
  const double z = (120 * 60 * 30.0 - 60 * 38 * 19.0) / (120 * 60 - 60 * 38) * 1e-3;
  EXPECT_LT((centreOfMass(bridge) - Eigen::Vector3d(0, 0, z)).norm(), 1e-6);
}

TEST(Sampling, BadInputIsNamed) {
  const ObjectModel model = boxModel(0.15, 0.04, 0.06);
  GripperOptions gripper;
  EXPECT_THAT(refusal([&] { readOptions(parseYaml("opening_max: -1"), &gripper); }),
              HasSubstr("opening_max = -1 must be above opening_min"));
  EXPECT_THAT(refusal([&] { readOptions(parseYaml("body: [{size: [0, 1, 1]}]"), &gripper); }),
              HasSubstr("size[0] = 0"));
  gripper.friction = 0;
  EXPECT_THAT(refusal([&] { sampleGrasps(model, gripper); }), HasSubstr("friction = 0"));
  GraspSamplingOptions options;
  options.step = 0;
  EXPECT_THAT(refusal([&] { sampleGrasps(model, {}, options); }), HasSubstr("step = 0 must be positive"));
  EXPECT_THAT(refusal([&] { sampleGrasps(ObjectModel{}, {}); }), HasSubstr("not built"));
}

}  // namespace
}  // namespace monocular_eye_hand
