#include "monocular_eye_hand/model/interior.h"

#include <gtest/gtest.h>

#include "model/build_model.h"
#include "monocular_eye_hand/mesh/load_mesh.h"

namespace monocular_eye_hand {
namespace {

/// A closed box from corner to corner.
Mesh boxMesh(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1 ? b : a).x(), (i & 2 ? b : a).y(), (i & 4 ? b : a).z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

ObjectModel centredBox(double x, double y, double z) {
  return buildModel("box", boxMesh(Eigen::Vector3d(-x, -y, -z) / 2, Eigen::Vector3d(x, y, z) / 2));
}

Rigid3 shifted(double x, double y, double z) { return {Eigen::Matrix3d::Identity(), {x, y, z}}; }

bool meet(const ObjectModel& a, const ObjectModel& b, const Rigid3& a_from_b, double depth = 0.004) {
  return interpenetrate(a, innerPoints(a, depth), b, innerPoints(b, depth), a_from_b);
}

TEST(Interior, InsideIsInside) {
  const ObjectModel b = centredBox(0.04, 0.06, 0.02);
  EXPECT_TRUE(insideSolid(b, {0, 0, 0}));
  EXPECT_TRUE(insideSolid(b, {0.0199, -0.0299, 0.0099}));
  EXPECT_FALSE(insideSolid(b, {0.0201, 0, 0}));
  EXPECT_FALSE(insideSolid(b, {1, 1, 1}));
}

TEST(Interior, AHoleIsOutside) {
  const ObjectModel frame =
      buildModel("frame", loadMesh(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/models/frame.ply", "mm"));
  EXPECT_FALSE(insideSolid(frame, frame.centre()));
  const std::vector<Eigen::Vector3d> inner = innerPoints(frame, 0.003);
  EXPECT_GT(inner.size(), 100u);
  for (const Eigen::Vector3d& p : inner) EXPECT_TRUE(insideSolid(frame, p));
}

TEST(Interior, AnOpenMeshHasNoInside) {
  Mesh mesh = boxMesh(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(0.05));
  mesh.triangles.pop_back();
  const ObjectModel open = buildModel("open", mesh);
  EXPECT_FALSE(insideSolid(open, {0.025, 0.025, 0.025}));
  EXPECT_TRUE(innerPoints(open, 0.004).empty());
}

TEST(Interior, InnerPointsKeepTheirDepthAndNumber) {
  const ObjectModel b = centredBox(0.04, 0.06, 0.02);
  const std::vector<Eigen::Vector3d> inner = innerPoints(b, 0.004);
  ASSERT_FALSE(inner.empty());
  for (const Eigen::Vector3d& p : inner) {
    EXPECT_LE(p.cwiseAbs().x(), 0.016 + 1e-9);
    EXPECT_LE(p.cwiseAbs().y(), 0.026 + 1e-9);
    EXPECT_LE(p.cwiseAbs().z(), 0.006 + 1e-9);
  }
  EXPECT_LE(innerPoints(b, 0.001, 50).size(), 50u);
  // A sheet thinner than twice the depth still has a middle.
  EXPECT_FALSE(innerPoints(centredBox(0.04, 0.06, 0.003), 0.004).empty());
}

TEST(Interior, WhatReachesIntoEachOtherDoesWhatTouchesDoesNot) {
  const ObjectModel b = centredBox(0.04, 0.04, 0.04), bar = centredBox(0.2, 0.012, 0.012);
  EXPECT_TRUE(meet(b, b, shifted(0.03, 0, 0)));
  EXPECT_FALSE(meet(b, b, shifted(0.038, 0, 0)));  // 2 mm deep
  EXPECT_FALSE(meet(b, b, shifted(0.05, 0, 0)));
  EXPECT_TRUE(meet(b, bar, shifted(0, 0.01, 0)));  // no corner of one lies in the other
  EXPECT_TRUE(meet(bar, b, shifted(0, -0.01, 0)));
  Rigid3 crossing;
  crossing.rotation = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_TRUE(meet(bar, bar, crossing));
  crossing.translation.z() = 0.013;
  EXPECT_FALSE(meet(bar, bar, crossing));
}

}  // namespace
}  // namespace monocular_eye_hand
