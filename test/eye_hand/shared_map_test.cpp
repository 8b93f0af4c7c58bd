#include "monocular_eye_hand/eye_hand/shared_map.h"

#include <gtest/gtest.h>

#include "cube_on_table.h"
#include "model/build_model.h"

namespace monocular_eye_hand {
namespace {

/// A solid block whose foot's middle is the origin: two of them cannot be in one place.
ModelBase block() {
  Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back(k & 1 ? 0.02 : -0.02, k & 2 ? 0.03 : -0.03, k & 4 ? 0.05 : 0);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  ModelBase models;
  models.objects.push_back({buildModel("block", mesh), {}});
  return models;
}

TEST(SharedMap, WhatHadYieldedHasTheStampOfItsLastView) {
  const ModelBase models = block();
  SharedMap map(&models, {});
  const auto see = [&](int stamp, const std::vector<Eigen::Vector3d>& feet) {
    ObjectView seen = cubeView(stamp, 0.3);
    const Rigid3 camera = lookingDown(0.4 + 0.02 * stamp, 0, 0.8);
    seen.hand.base_from_tool0 = camera;
    seen.objects.clear();
    for (const Eigen::Vector3d& foot : feet) seen.objects.push_back(seenCube(camera, foot));
    map.add(seen, nanosecondsOf(stamp));
  };
  const Eigen::Vector3d there(0.5, 0, 0.3), beside(0.53, 0, 0.3);
  for (int stamp = 1; stamp <= 8; ++stamp) see(stamp, {there});
  for (int stamp = 9; stamp <= 11; ++stamp) see(stamp, {});
  see(12, {beside});
  ASSERT_EQ(map.known().map.objects.size(), 1u);
  EXPECT_EQ(map.known().map.objects[0].number, 0);
  see(13, {});  // the first one was missed for the fifth time
  ASSERT_EQ(map.known().map.objects.size(), 1u);
  EXPECT_EQ(map.known().map.objects[0].number, 1);
  EXPECT_EQ(map.known().stamps[0], nanosecondsOf(12));
}

TEST(SharedMap, StampsAreKeptToTheNanosecond) {
  ModelBase models = cube();
  models.objects.push_back(models.objects[0]);
  models.objects[1].model.name = "other";
  SharedMap map(&models, {});
  ObjectView seen = cubeView(0, 0.3);
  seen.known = {};
  SeenObject first_cube, other;
  first_cube.object = 0;
  other.object = 1;
  first_cube.covariance = other.covariance = Matrix6d::Identity() * 1e-8;
  first_cube.camera_from_object.translation = {0, 0, -1};  // behind the camera: never missed
  other.camera_from_object.translation = {0.5, 0, -1};

  const Nanoseconds first = 1700000000123456789, second = 1700000001987654321;
  seen.objects = {first_cube, other};
  seen.stamp = secondsOf(first);
  map.add(seen, first);
  seen.objects = {other};
  seen.stamp = secondsOf(second);
  map.add(seen, second);

  const KnownObjects known = map.known();
  ASSERT_EQ(known.stamps.size(), 2u);
  EXPECT_EQ(known.stamps[0], first);
  EXPECT_EQ(known.stamps[1], second);
  EXPECT_EQ(known.stamp, second);
  EXPECT_NE(map.add(seen, second).report.refused, "");
  EXPECT_NE(map.known().map.refused, "");

  const Nanoseconds forgotten = 1700000003000000000, late = 1700000002000000000;
  EXPECT_EQ(map.forget(first_cube.object, 0, forgotten), 1);
  EXPECT_EQ(map.forget(first_cube.object, 0, forgotten), 0);
  seen.stamp = secondsOf(late);
  EXPECT_NE(map.add(seen, late).report.refused, "") << "taken before it was carried away";
  seen.stamp = secondsOf(second);
  EXPECT_EQ(map.forget(-1, -1, forgotten), 1);
  EXPECT_EQ(map.add(seen, second).report.refused, "");  // stamps may start again

  map.clear();
  EXPECT_EQ(map.known().stamp, 0);
  EXPECT_TRUE(map.known().map.objects.empty());
}

}  // namespace
}  // namespace monocular_eye_hand
