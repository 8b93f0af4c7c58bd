#include <gtest/gtest.h>

#include <cmath>

#include "execution/drop_zone.h"

namespace monocular_eye_hand {
namespace {

Mesh block(double length, double width, double height) {
  Mesh mesh;
  for (double x : {0.0, length})
    for (double y : {0.0, width})
      for (double z : {0.0, height}) mesh.vertices.emplace_back(x, y, z);
  return mesh;
}

Rigid3 pose(double x, double y, double z, double yaw) {
  Rigid3 pose;
  pose.rotation = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation = {x, y, z};
  return pose;
}

TEST(FootprintBox, OfATurnedBlock) {
  const Rigid3 base_from_block = pose(0.5, 0.1, 0.3, 0.4);
  const FootprintBox footprint = footprintOf(block(0.12, 0.04, 0.06), base_from_block);
  const Eigen::Vector3d centre = base_from_block * Eigen::Vector3d(0.06, 0.02, 0);
  EXPECT_LT((footprint.centre - centre.head<2>()).norm(), 1e-6);
  EXPECT_NEAR(footprint.yaw, 0.4, 1e-5);
  EXPECT_NEAR(footprint.length, 0.12, 1e-6);
  EXPECT_NEAR(footprint.width, 0.04, 1e-6);
}

TEST(FootprintBox, OfABlockThatStandsOnItsEnd) {
  Rigid3 upright = pose(0, 0, 0, 0);
  upright.rotation = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const FootprintBox footprint = footprintOf(block(0.12, 0.04, 0.06), upright);
  EXPECT_NEAR(footprint.length, 0.06, 1e-6);
  EXPECT_NEAR(footprint.width, 0.04, 1e-6);
}

TEST(DropTargets, ThePartStandsAtThePlaceAsItStood) {
  const Mesh mesh = block(0.12, 0.04, 0.06);
  const Rigid3 base_from_block = pose(0.5, 0.1, 0.3, 0.4);
  const FootprintBox footprint = footprintOf(mesh, base_from_block);
  Rigid3 grasp = pose(0.52, 0.12, 0.35, 0.4);
  grasp.rotation = grasp.rotation * Eigen::AngleAxisd(2.9, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Rigid3 tcp_from_block = grasp.inverse() * base_from_block;

  DropPlace place;
  place.x = 0.4;
  place.y = -0.3;
  place.yaw = 1.5;
  const std::vector<DropTarget> drops = dropTargets(place, footprint, grasp, 0.001, 0.1);
  ASSERT_EQ(drops.size(), 8u);

  for (size_t k = 0; k < drops.size(); ++k) {
    const Rigid3 put = drops[k].base_from_tcp * tcp_from_block;
    EXPECT_NEAR(put.translation.z(), 0.301, 1e-9) << "it stands as high as before, and the gap";
    EXPECT_LT((put.rotation.col(2) - Eigen::Vector3d::UnitZ()).norm(), 1e-9) << "turned about the vertical";
    const FootprintBox there = footprintOf(mesh, put);
    EXPECT_LT((there.centre - Eigen::Vector2d(0.4, -0.3)).norm(), 1e-5);
    const double off = std::remainder(there.yaw - 1.5, M_PI);  // the long side has no front
    const double wanted[] = {0, M_PI / 2, M_PI / 4, -M_PI / 4};
    EXPECT_NEAR(std::remainder(off - wanted[k / 2], M_PI), 0, 1e-4) << k;
    const Eigen::Vector3d down =
        drops[k].base_from_tcp_above.translation - drops[k].base_from_tcp.translation;
    EXPECT_LT((down - Eigen::Vector3d(0, 0, 0.099)).norm(), 1e-9);
    EXPECT_LT((drops[k].base_from_tcp_above.rotation - drops[k].base_from_tcp.rotation).norm(), 1e-12);
  }

  EXPECT_LT(angleBetween(grasp.rotation, drops[0].base_from_tcp.rotation),
            angleBetween(grasp.rotation, drops[1].base_from_tcp.rotation))
      << "the smaller turn first";
}

}  // namespace
}  // namespace monocular_eye_hand
