#include "monocular_eye_hand/simulation/cell/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "cell_world.h"
#include "lowest.h"
#include "monocular_eye_hand/options/options.h"
#include "simulation/scenes/footprint.h"
#include "support/refusal.h"

using namespace monocular_eye_hand;

namespace {

void expectSideBySide(const Scene& scene) {
  for (size_t a = 0; a < scene.objects.size(); ++a) {
    EXPECT_NEAR(lowest(scene.objects[a]), 0, 1e-9) << scene.objects[a].name;
    for (size_t b = 0; b < a; ++b)
      EXPECT_EQ(footprintOverlap(scene.objects[a], scene.objects[b]), 0)
          << scene.objects[a].name << " " << scene.objects[b].name;
  }
}

void expectInsideFrame(const Scene& scene) {
  Eigen::AlignedBox3d frame;
  for (const Eigen::Vector3d& p : scene.objects[0].mesh->vertices) frame.extend(p);
  for (size_t k = 1; k < scene.objects.size(); ++k)
    for (const Eigen::Vector3d& p : scene.objects[k].mesh->vertices) {
      const Eigen::Vector3d q =
          scene.objects[0].world_from_object.inverse() * (scene.objects[k].world_from_object * p);
      EXPECT_TRUE(std::abs(q.x()) < 0.120 && std::abs(q.y()) < 0.080) << q.transpose();
    }
}

std::string refusalOf(const std::string& yaml) {
  CellOptions options;
  return refusal([&] {
    readOptions(parseYaml(yaml), &options);
    makeCellScene(options, partMeshes());
  });
}

}  // namespace

TEST(CellScene, DefaultIsTheFrameWithThreeParts) {
  const CellScene cell = makeCellScene({}, partMeshes());
  ASSERT_EQ(cell.scene.objects.size(), 4u);
  EXPECT_EQ(cell.scene.objects[0].name, "frame");
  EXPECT_TRUE(cell.fixed[0]);
  expectSideBySide(cell.scene);
  expectInsideFrame(cell.scene);
  EXPECT_NEAR(cell.baseFromObject(0).translation.z(), 0.30, 1e-12);
  EXPECT_NEAR(cell.baseFromObject(0).translation.x(), 0.55, 1e-12);
}

TEST(CellScene, ASeedIsOneArrangement) {
  const auto models = partMeshes();
  CellOptions options;
  for (int seed = 0; seed < 3; ++seed) {
    options.random.seed = seed;
    const CellScene cell = makeCellScene(options, models), again = makeCellScene(options, models);
    ASSERT_EQ(cell.scene.objects.size(), 4u);
    expectSideBySide(cell.scene);
    expectInsideFrame(cell.scene);
    for (size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(cell.scene.objects[k].world_from_object.translation,
                again.scene.objects[k].world_from_object.translation);
      EXPECT_EQ(cell.scene.objects[k].name == "frame", k == 0);
    }
    EXPECT_EQ(cell.scene.table.material.albedo, again.scene.table.material.albedo);
  }
}

TEST(CellScene, PartsInTheAirAreSetDown) {
  CellOptions options;
  options.objects.resize(1);
  CellObject part;
  part.name = "grenade";
  part.pose.z = 0.2;
  part.pose.x = -0.135;  // above the frame's left side
  options.objects.push_back(part);
  const CellScene cell = makeCellScene(options, partMeshes());
  EXPECT_NEAR(lowest(cell.scene.objects[1]), 0.025, 1e-6);
}

TEST(CellScene, YamlIsReadAndBadYamlRefusedByName) {
  using testing::HasSubstr;
  CellOptions options;
  readOptions(parseYaml("{table: {pose: {z: 0.4}}, objects: [{name: flange, pose: {x: 0.1}}], seed: 5, "
                        "camera: {distortion: []}}"),
              &options);
  const CellScene cell = makeCellScene(options, partMeshes());

  EXPECT_EQ(cell.scene.objects.at(0).name, "flange");
  EXPECT_NEAR(cell.baseFromObject(0).translation.z(), 0.4, 1e-12);
  EXPECT_NEAR(cell.baseFromObject(0).translation.x(), 0.65, 1e-12);
  EXPECT_FALSE(cell.camera.distorted());
  EXPECT_THAT(refusalOf("{tabel: {}}"), HasSubstr("tabel"));
  EXPECT_THAT(refusalOf("{objects: [{name: teapot}]}"), HasSubstr("teapot"));
  EXPECT_THAT(refusalOf("{objects: [{name: bridge, pose: {z: -0.02}}]}"), HasSubstr("sinks"));
  EXPECT_THAT(refusalOf("{table: {material: {texture: {kind: tartan}}}}"), HasSubstr("tartan"));
  EXPECT_THAT(refusalOf("{camera: {distortion: [0.1, 0.2]}}"), HasSubstr("distortion"));
  EXPECT_THAT(refusalOf("{drop_zone: {y: 0.9}}"), HasSubstr("drop_zone"));
  EXPECT_THAT(refusalOf("{step: 0}"), HasSubstr("step"));
  EXPECT_THAT(refusalOf("{random: {seed: 1, objects: 20}}"), HasSubstr("random.objects"));
  EXPECT_THAT(refusalOf("{random: {seed: 1, gripper_width: 0.006}}"), HasSubstr("gripper_width"));
  EXPECT_THAT(refusalOf("{random: {seed: 1, frame: bucket}}"), HasSubstr("bucket"));
}
