#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>

#include "lowest.h"
#include "mesh_checks.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/camera_file.h"
#include "monocular_eye_hand/mesh/stable_poses.h"
#include "monocular_eye_hand/simulation/render/truth.h"
#include "monocular_eye_hand/simulation/scenes/random_scene.h"
#include "simulation/scenes/footprint.h"

using namespace monocular_eye_hand;

namespace {

std::vector<NamedMesh> parts() {
  return {{"block", std::make_shared<Mesh>(boxMesh({0.08, 0.05, 0.03}))},
          {"can", std::make_shared<Mesh>(cylinderMesh(0.025, 0.07))},
          {"cone", std::make_shared<Mesh>(coneMesh(0.03, 0.01, 0.05))}};
}

}  // namespace

TEST(Shapes, AreClosedAndPointOutwards) {
  const double r = 0.03, h = 0.08;
  EXPECT_NEAR(volume(boxMesh({0.1, 0.2, 0.3})), 0.006, 1e-12);
  EXPECT_NEAR(volume(cylinderMesh(r, h, 200)), M_PI * r * r * h, 1e-3 * M_PI * r * r * h);
  EXPECT_NEAR(volume(coneMesh(r, 0, h, 200)), M_PI * r * r * h / 3, 1e-3 * M_PI * r * r * h);
  EXPECT_NEAR(volume(sphereMesh(r, 80)), 4.0 / 3 * M_PI * r * r * r, 2e-3 * 4.0 / 3 * M_PI * r * r * r);
  for (const Mesh& mesh : {boxMesh({0.1, 0.2, 0.3}), cylinderMesh(r, h), coneMesh(r, 0.01, h), sphereMesh(r)})
    EXPECT_TRUE(closed(mesh));
  EXPECT_THROW(boxMesh({0.1, 0, 0.1}), BadInput);
  EXPECT_THROW(cylinderMesh(-1, 1), BadInput);
}

TEST(LookAt, PutsTheTargetInTheMiddleAndUpUp) {
  const Eigen::Vector3d eye(0.3, -0.5, 0.4), target(0.02, 0.01, 0.03);
  const Rigid3 camera_from_world = lookAt(eye, target).inverse();
  EXPECT_TRUE((camera_from_world * target).isApprox(Eigen::Vector3d(0, 0, (target - eye).norm()), 1e-12));
  const Eigen::Vector3d up = camera_from_world.rotation * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(up.x(), 0, 1e-12);
  EXPECT_LT(up.y(), 0);  // image v points down
  EXPECT_NEAR(lookAt(eye, target, 0.4).rotation.determinant(), 1, 1e-12);
  EXPECT_TRUE(lookAt({0, 0, 1}, {0, 0, 0}).isFinite());
  EXPECT_THROW(lookAt(eye, eye), BadInput);
}

TEST(StablePoses, OfABoxAreItsSixFaces) {
  const std::vector<StablePose> poses = stablePoses(boxMesh({0.10, 0.06, 0.02}));
  ASSERT_EQ(poses.size(), 6u);
  double sum = 0;
  std::multiset<int> heights;
  for (const StablePose& pose : poses) {
    sum += pose.weight;
    double low = 1e9, high = -1e9;
    for (const Eigen::Vector3d& p : boxMesh({0.10, 0.06, 0.02}).vertices) {
      const double z = (pose.table_from_object * p).z();
      low = std::min(low, z);
      high = std::max(high, z);
    }
    EXPECT_NEAR(low, 0, 1e-9);
    heights.insert(int(std::lround(1000 * high)));
    const Eigen::Vector3d centre = pose.table_from_object * Eigen::Vector3d(0, 0, 0.01);
    EXPECT_NEAR(centre.head<2>().norm(), 0, 1e-9);
  }

  EXPECT_EQ(heights, (std::multiset<int>{20, 20, 60, 60, 100, 100}));
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_GT(poses.front().weight, 2 * poses.back().weight);  // flat is safer than on end
}

TEST(StablePoses, ConeDoesNotStandOnItsTip) {
  for (const StablePose& pose : stablePoses(coneMesh(0.04, 0, 0.06, 24))) {
    const Eigen::Vector3d tip = pose.table_from_object * Eigen::Vector3d(0, 0, 0.06);
    const Eigen::Vector3d base = pose.table_from_object * Eigen::Vector3d(0, 0, 0);
    EXPECT_TRUE(tip.z() > 0.059 || base.z() > 0.01) << "standing, or lying on its side";
    EXPECT_FALSE(tip.z() < 1e-6 && base.z() > 0.055) << "on its tip";
  }
  EXPECT_THROW(stablePoses(quadMesh(1, 1)), BadInput);
  EXPECT_THROW(stablePoses(Mesh{}), BadInput);
}

TEST(StablePoses, LeaningOverAGapRestsOnTheHull) {
  // An L of two boxes, as one mesh: lying on the inside of the L it rests on two edges that no face joins.
  Mesh mesh = boxMesh({0.10, 0.04, 0.02});
  const Mesh upright = boxMesh({0.02, 0.04, 0.10});
  const int base = int(mesh.vertices.size());
  for (const Eigen::Vector3d& p : upright.vertices)
    mesh.vertices.push_back(p + Eigen::Vector3d(-0.04, 0, 0.02));
  for (auto t : upright.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  int slanted = 0;
  for (const StablePose& pose : stablePoses(mesh))
    slanted += pose.table_from_object.rotation.row(2).cwiseAbs().maxCoeff() < 0.99;
  EXPECT_GE(slanted, 1);
}

TEST(RandomScene, StandsOnTheTableWithoutTouching) {
  for (SceneLevel level : {SceneLevel::kEasy, SceneLevel::kMedium, SceneLevel::kHard})
    for (uint32_t seed = 0; seed < 6; ++seed) {
      const Scene scene = randomScene(parts(), seed, level);
      ASSERT_FALSE(scene.objects.empty());
      EXPECT_FALSE(scene.lights.empty());
      for (size_t a = 0; a < scene.objects.size(); ++a) {
        EXPECT_NEAR(lowest(scene.objects[a]), 0, 1e-4);
        for (size_t b = 0; b < a; ++b) EXPECT_EQ(footprintOverlap(scene.objects[a], scene.objects[b]), 0);
      }
    }
}

TEST(RandomScene, FollowsSeedAndLevel) {
  const auto known = [](const Scene& scene) {
    int count = 0;
    for (const SceneObject& object : scene.objects) count += object.model >= 0;
    return count;
  };

  for (uint32_t seed = 0; seed < 5; ++seed) {
    const Scene easy = randomScene(parts(), seed, SceneLevel::kEasy),
                hard = randomScene(parts(), seed, SceneLevel::kHard);
    EXPECT_LE(known(easy), 3);
    EXPECT_EQ(known(easy), int(easy.objects.size()));
    EXPECT_GT(hard.objects.size(), easy.objects.size());
    const Scene again = randomScene(parts(), seed, SceneLevel::kHard);
    ASSERT_EQ(again.objects.size(), hard.objects.size());
    for (size_t k = 0; k < again.objects.size(); ++k)
      EXPECT_EQ(again.objects[k].world_from_object.translation,
                hard.objects[k].world_from_object.translation);
  }

  const Scene one = randomScene(parts(), 1, SceneLevel::kEasy),
              two = randomScene(parts(), 2, SceneLevel::kEasy);
  EXPECT_NE(one.world_from_camera.translation, two.world_from_camera.translation);
  EXPECT_EQ(known(randomClutter(3)), 0);
  EXPECT_GT(randomClutter(3).objects.size(), 3u);
  EXPECT_THROW(randomScene({}, 1, SceneLevel::kEasy), BadInput);
  RandomSceneOptions options;
  options.max_distance = 0.1;
  EXPECT_THROW(randomScene(parts(), 1, options), BadInput);
}

TEST(FootprintOverlap, SeesOverlapAndHoles) {
  SceneObject a{"a", 0, std::make_shared<Mesh>(boxMesh({0.10, 0.10, 0.02})), {}, {}}, b = a;
  b.world_from_object.translation = {0.05, 0, 0};
  EXPECT_NEAR(footprintOverlap(a, b), 0.5, 0.02);
  b.world_from_object.translation = {0.11, 0, 0};
  EXPECT_EQ(footprintOverlap(a, b), 0);
}

TEST(Truth, ReadsBackWhatItWrote) {
  const std::string folder = testing::TempDir();
  TruthObject object;
  object.name = "bridge";
  object.model = 3;
  object.camera_from_object = {expSO3({0.3, -2, 0.7}), {0.01, -0.02, 0.6}};
  object.visible_fraction = 0.75;
  object.box_visible = {1, 2, 30, 40};
  writeTruth(folder + "truth.json", {object});
  const std::vector<TruthObject> read = readTruth(folder + "truth.json");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, "bridge");
  EXPECT_EQ(read[0].model, 3);
  EXPECT_TRUE(read[0].camera_from_object.rotation.isApprox(object.camera_from_object.rotation, 1e-12));
  EXPECT_TRUE(read[0].camera_from_object.translation.isApprox(object.camera_from_object.translation, 1e-12));
  EXPECT_EQ(read[0].visible_fraction, 0.75);
  EXPECT_EQ(read[0].box_visible, object.box_visible);
  EXPECT_THROW(readTruth(folder + "not_there.json"), BadInput);

  std::ofstream(folder + "broken.json") << "{\"objects\": [{\"name\": 3}]}";
  EXPECT_THROW(readTruth(folder + "broken.json"), BadInput);
}

TEST(Truth, CameraReadsBack) {
  const std::string path = testing::TempDir() + "written_camera.yaml";
  Camera camera{
      640, 480, 620.25, 621.5, 322.7, 236.4, DistortionModel::kPlumbBob, {-0.28, 0.08, 0.001, -0.0005, 0.02}};
  for (DistortionModel model :
       {DistortionModel::kPlumbBob, DistortionModel::kRationalPolynomial, DistortionModel::kEquidistant}) {
    camera.model = model;
    if (model == DistortionModel::kEquidistant) camera.d = {-0.02, 0.01, 0.003, -0.001};
    if (model == DistortionModel::kRationalPolynomial) camera.d[7] = 0.01;
    writeCamera(path, camera);
    const Camera read = loadCamera(path);
    EXPECT_EQ(read.width, 640);
    EXPECT_EQ(read.height, 480);
    EXPECT_EQ(read.model, model);
    EXPECT_TRUE(read.distort({100, 80}).isApprox(camera.distort({100, 80}), 1e-12));
  }
  EXPECT_THROW(writeCamera("/nowhere/at/all.yaml", camera), BadInput);
}
