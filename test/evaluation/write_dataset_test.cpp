#include "monocular_eye_hand/evaluation/write_dataset.h"

#include <gmock/gmock.h>

#include "evaluation/pose_error.h"
#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"
#include "small_dataset.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Mesh brick(const Eigen::Vector3d& size) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1 ? 0.5 : -0.5) * size.x(), (i & 2 ? 0.5 : -0.5) * size.y(),
                               (i & 4 ? 0.5 : -0.5) * size.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Mesh tetrahedron() {
  return {{{0, 0, 0}, {0.1, 0, 0}, {0, 0.07, 0}, {0, 0, 0.04}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

Mesh wheel() {
  constexpr int kSides = 64;
  Mesh mesh;
  mesh.vertices = {{0.01, 0, 0}, {0.01, 0, 0.02}};
  for (int k = 0; k < kSides; ++k)
    for (int side = 0; side < 2; ++side)
      mesh.vertices.emplace_back(0.01 + 0.03 * std::cos(2 * M_PI * k / kSides),
                                 0.03 * std::sin(2 * M_PI * k / kSides), 0.02 * side);
  for (int k = 0; k < kSides; ++k) {
    const int a = 2 + 2 * k, b = 2 + 2 * ((k + 1) % kSides);
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({1, a + 1, b + 1});
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  return mesh;
}

Camera smallCamera() { return {64, 48, 70.5, 70.5, 31.25, 23, DistortionModel::kNone, {}}; }

WrittenTruth truth(int object, double visible) {
  const GroundTruth gt{object, {expSO3({0.3, -2, 0.7}), {0.01, -0.02, 0.6}}, visible};
  return {gt, cv::Rect(3, 4, 5, 6), 100, int(100 * visible)};
}

cv::Mat grey(int value) { return cv::Mat(48, 64, CV_8UC1, cv::Scalar(value)); }

TEST(WriteDataset, IdsComeFromNamesThatHaveThem) {
  EXPECT_THAT(bopIds({"obj_000012", "obj_000003"}), ElementsAre(12, 3));
  EXPECT_THAT(bopIds({"bridge", "flange"}), ElementsAre(1, 2));
  EXPECT_THAT(bopIds({"bolt_8", "nut_8"}), ElementsAre(1, 2)) << "the same number twice";
  EXPECT_THAT(bopIds({"part0", "part1"}), ElementsAre(1, 2)) << "ids count from 1";
  EXPECT_THAT(bopIds({}), ElementsAre());
}

TEST(WriteDataset, ModelsReadBack) {
  TempFolder folder;
  writeBopModels(folder.path(), {{7, buildModel("wedge", tetrahedron())},
                                 {12, buildModel("brick", brick({0.1, 0.06, 0.02}))}});
  const BopModels models = loadBopModels(folder.path("models"));
  ASSERT_EQ(models.size(), 2u);
  const BopModel& wedge = models.at(7);
  EXPECT_EQ(wedge.name, "wedge");
  EXPECT_NEAR(wedge.diameter, std::hypot(0.1, 0.07), 1e-12);
  EXPECT_FALSE(wedge.symmetries.any());
  ASSERT_EQ(wedge.vertices.size(), 4u);
  double farthest = 0;
  for (const Eigen::Vector3d& p : wedge.vertices) farthest = std::max(farthest, p.x());
  EXPECT_NEAR(farthest, 0.1, 1e-8) << "millimetres in the file, metres here";
  EXPECT_EQ(models.at(12).symmetries.discrete.size(), 3u) << "a brick has three half turns";
}

TEST(WriteDataset, SymmetriesLeaveEveryErrorAtZero) {
  TempFolder folder;
  const ObjectModel model = buildModel("wheel", wheel());
  writeBopModels(folder.path(), {{1, model}});
  const BopModel read = loadBopModels(folder.path("models")).at(1);
  ASSERT_EQ(read.symmetries.continuous.size(), 1u);
  EXPECT_NEAR(std::abs(read.symmetries.continuous[0].direction.z()), 1, 1e-6);
  ASSERT_EQ(read.symmetries.discrete.size(), 1u) << "the flip";

  // Turned by a third of its facets' number about its own axis, and flipped: the same to the eye.
  const Rigid3 truth{expSO3({0.2, 0.4, -1}), {0.02, 0.01, 0.5}};
  const double angle = 2 * M_PI * 21 / 64;
  const Eigen::Vector3d centre(0.01, 0, 0.01);
  const Eigen::Matrix3d turn = expSO3({0, 0, angle}), flip = expSO3({M_PI, 0, 0});
  for (const Eigen::Matrix3d& rotation : {turn, flip, Eigen::Matrix3d(turn * flip)}) {
    const Rigid3 same = truth * Rigid3{rotation, centre - rotation * centre};
    EXPECT_LT(mssd(same, truth, read.vertices, discretized(read.symmetries)), 0.0005);
    EXPECT_GT(mssd(same, truth, read.vertices, {Rigid3{}}), 0.015) << "without symmetries it is far off";
  }
}

TEST(WriteDataset, SceneReadsBack) {
  TempFolder folder;
  writeBopCamera(folder.path(), smallCamera());
  BopSceneWriter writer(folder.path(), "train", 4);
  writer.add({0, smallCamera(), {truth(7, 0.75), truth(7, 0.05), truth(12, 1)}}, grey(10));
  writer.add({3, smallCamera(), {}}, grey(20));
  writer.finish();

  const BopSplit split = loadBopSplit(folder.path(), "train");
  EXPECT_EQ(split.width, 64);
  ASSERT_EQ(split.images.size(), 2u);
  const BopImage& image = split.images[0];
  EXPECT_EQ(image.scene, 4);
  EXPECT_EQ(bopCamera(image, 64, 48).fx, 70.5);
  EXPECT_EQ(bopCamera(image, 64, 48).cx, 31.25);
  EXPECT_EQ(loadBopImage(split.images[1]).at<uchar>(5, 5), 20);
  ASSERT_EQ(image.truth.size(), 3u);
  EXPECT_EQ(image.truth[2].object, 12);
  EXPECT_EQ(image.truth[0].visible, 0.75);
  const Rigid3 expected = truth(7, 1).truth.camera_from_object;
  EXPECT_TRUE(image.truth[0].camera_from_object.rotation.isApprox(expected.rotation, 1e-14));
  EXPECT_TRUE(image.truth[0].camera_from_object.translation.isApprox(expected.translation, 1e-14));
  EXPECT_TRUE(split.images[1].truth.empty());
}

TEST(WriteDataset, WhereTheCameraStandsReadsBackAndMayBeLeftOut) {
  const Rigid3 camera_from_world{expSO3({0.3, -0.2, 0.1}), {0.1, -0.2, 0.75}};
  TempFolder folder;
  writeBopCamera(folder.path(), smallCamera());
  BopSceneWriter writer(folder.path(), "train", 1);
  writer.add({0, smallCamera(), {}, camera_from_world}, grey(10));
  writer.add({1, smallCamera(), {}}, grey(10));
  writer.finish();

  const BopSplit split = loadBopSplit(folder.path(), "train");
  ASSERT_EQ(split.images.size(), 2u);
  ASSERT_TRUE(split.images[0].camera_from_world);
  EXPECT_TRUE(split.images[0].camera_from_world->rotation.isApprox(camera_from_world.rotation, 1e-12));
  EXPECT_TRUE(split.images[0].camera_from_world->translation.isApprox(camera_from_world.translation, 1e-12));
  EXPECT_FALSE(split.images[1].camera_from_world);
}

TEST(WriteDataset, TargetsOfAllScenesAreThoseThatAreVisible) {
  TempFolder folder;
  writeBopCamera(folder.path(), smallCamera());
  for (const int scene : {2, 1, 2}) {  // a scene that is written again takes its old targets' place
    BopSceneWriter writer(folder.path(), "train", scene);
    writer.add({0, smallCamera(), {truth(7, 0.75), truth(7, 0.05), truth(12, 1), truth(12, 0.1)}}, grey(10));
    writer.finish();
  }
  const auto written = loadBopTargets(folder.path("train_targets_bop19.json"));
  const auto expected = visibleTargets(loadBopSplit(folder.path(), "train"));
  ASSERT_EQ(written.size(), 4u);
  ASSERT_EQ(expected.size(), 4u);
  for (size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(written[k].scene, expected[k].scene);
    EXPECT_EQ(written[k].object, expected[k].object);
    EXPECT_EQ(written[k].count, expected[k].count);
  }
  EXPECT_EQ(written[1].count, 2);
}

TEST(WriteDataset, WhatIsThereStays) {
  TempFolder folder;
  const BopPart brick_part{1, buildModel("brick", brick({0.1, 0.06, 0.02}))};
  writeBopModels(folder.path(), {brick_part});
  EXPECT_NO_THROW(writeBopModels(folder.path(), {brick_part}));
  EXPECT_THAT(refusal([&] {
                writeBopModels(folder.path(), {{1, buildModel("brick", brick({0.1, 0.06, 0.03}))}});
              }),
              HasSubstr("obj_000001.ply: holds another model"));
  Camera wide = smallCamera();
  wide.width = 128;
  writeBopCamera(folder.path(), smallCamera());
  writeBopCamera(folder.path(), wide);
  BopSceneWriter writer(folder.path(), "train", 1);
  writer.add({0, smallCamera(), {}}, grey(1));
  writer.finish();
  EXPECT_EQ(loadBopSplit(folder.path(), "train").width, 64);
}

TEST(WriteDataset, WhatTheFormatCannotSayIsRefused) {
  TempFolder folder;
  BopSceneWriter writer(folder.path(), "train", 1);
  Camera camera = smallCamera();
  camera.model = DistortionModel::kPlumbBob;
  camera.d = {-0.2, 0, 0, 0, 0};
  EXPECT_THROW(writer.add({0, camera, {}}, grey(1)), BadInput);
  EXPECT_THROW(writer.add({0, smallCamera(), {}}, cv::Mat(48, 60, CV_8UC1)), BadInput);
  const BopPart part{1, buildModel("brick", brick({0.1, 0.06, 0.02}))};
  EXPECT_THROW(writeBopModels(folder.path(), {part, part}), BadInput);
  folder.write("file", "");
  EXPECT_THROW(writeBopCamera(folder.path("file"), smallCamera()), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
