#include "monocular_eye_hand/evaluation/dataset.h"

#include <gmock/gmock.h>

#include "small_dataset.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

TEST(Dataset, Models) {
  TempFolder folder;
  writeSmallDataset(folder);
  const BopModels models = loadBopModels(folder.path("models"));
  ASSERT_EQ(models.size(), 2u);
  const BopModel &tetra = models.at(1), &plate = models.at(5);
  EXPECT_EQ(tetra.name, "tetra");
  EXPECT_EQ(plate.name, "obj_5");
  EXPECT_NEAR(tetra.diameter, 0.1414213562373095, 1e-15);
  ASSERT_EQ(tetra.vertices.size(), 4u);
  EXPECT_TRUE(tetra.vertices[3].isApprox(Eigen::Vector3d(0, 0, 0.1), 1e-7));
  EXPECT_FALSE(tetra.symmetries.any());
  ASSERT_EQ(plate.symmetries.discrete.size(), 1u);
  EXPECT_EQ(plate.symmetries.discrete[0].rotation(0, 0), -1);
}

TEST(Dataset, ContinuousSymmetryInMetresWithAUnitAxis) {
  TempFolder folder;
  folder.write("obj_000002.ply", tetrahedronPly());
  folder.write(
      "models_info.json",
      R"({"2": {"diameter": 100, "symmetries_continuous": [{"axis": [0, 0, 2], "offset": [10, 20, 30]}]}})");
  const auto axes = loadBopModels(folder.path()).at(2).symmetries.continuous;
  ASSERT_EQ(axes.size(), 1u);
  EXPECT_EQ(axes[0].direction, Eigen::Vector3d(0, 0, 1));
  EXPECT_TRUE(axes[0].point.isApprox(Eigen::Vector3d(0.01, 0.02, 0.03)));
}

TEST(Dataset, Split) {
  TempFolder folder;
  writeSmallDataset(folder);
  const BopSplit split = loadBopSplit(folder.path(), "dev");
  EXPECT_EQ(split.width, 640);
  ASSERT_EQ(split.images.size(), 3u);
  EXPECT_EQ(split.images[1].scene, 1);
  EXPECT_EQ(split.images[1].id, 3);
  ASSERT_EQ(split.images[1].truth.size(), 2u);
  EXPECT_EQ(split.images[1].truth[1].visible, 0.05);
  EXPECT_TRUE(split.images[1].truth[1].camera_from_object.translation.isApprox(Eigen::Vector3d(-0.2, 0, 1)));
  EXPECT_EQ(split.images[2].truth[0].visible, 1) << "without scene_gt_info.json all is visible";
  EXPECT_EQ(split.find(2, 0), &split.images[2]);
  EXPECT_EQ(split.find(1, 1), nullptr);
  for (const BopImage& image : split.images)
    EXPECT_EQ(loadBopImage(image).at<uchar>(7, 5), 200) << image.path;

  const Camera camera = bopCamera(split.images[0], 640, 480);
  EXPECT_EQ(camera.fx, 1000);
  EXPECT_EQ(camera.cy, 239.5);
  EXPECT_FALSE(camera.distorted());
}

TEST(Dataset, RestrictedToScenesAndImages) {
  TempFolder folder;
  writeSmallDataset(folder);
  EXPECT_EQ(loadBopSplit(folder.path(), "dev", {1}).images.size(), 2u);
  EXPECT_EQ(loadBopSplit(folder.path(), "dev", {}, {0}).images.size(), 2u);
  EXPECT_EQ(loadBopSplit(folder.path(), "dev", {1}, {3}).images.size(), 1u);
  EXPECT_THAT(refusal([&] { loadBopSplit(folder.path(), "dev", {7}); }), HasSubstr("there is no scene 7"));
  EXPECT_THAT(refusal([&] { loadBopSplit(folder.path(), "dev", {}, {9}); }), HasSubstr("no image"));
}

TEST(Dataset, Targets) {
  TempFolder folder;
  writeSmallDataset(folder);
  folder.write("t.json", R"([{"scene_id": 1, "im_id": 3, "obj_id": 1, "inst_count": 2}])");
  const auto targets = loadBopTargets(folder.path("t.json"));
  ASSERT_EQ(targets.size(), 1u);
  EXPECT_EQ(targets[0].count, 2);
  folder.write("t24.json", R"([{"scene_id": 1, "im_id": 3}])");
  EXPECT_THAT(refusal([&] { loadBopTargets(folder.path("t24.json")); }), HasSubstr("'obj_id' is missing"));
  const auto visible = visibleTargets(loadBopSplit(folder.path(), "dev"));
  ASSERT_EQ(visible.size(), 4u);  // the instance that is 5 % visible is none
  EXPECT_EQ(visible[2].image, 3);
  EXPECT_EQ(visible[2].count, 1);
}

TEST(Dataset, WidthOfASetWithoutCameraJsonIsItsImages) {
  TempFolder folder;
  writeSmallDataset(folder);
  std::filesystem::remove(folder.path("camera.json"));
  EXPECT_EQ(loadBopSplit(folder.path(), "dev").width, 640);
}

TEST(Dataset, WhatIsWrongIsNamed) {
  TempFolder folder;
  writeSmallDataset(folder);
  EXPECT_THAT(refusal([&] { loadBopSplit(folder.path(), "test"); }), HasSubstr("test: no such folder"));
  EXPECT_THAT(refusal([&] { loadBopModels(folder.path("no_models")); }),
              HasSubstr("models_info.json: cannot be read"));
  folder.write("models/models_info.json", R"({"7": {"diameter": 10}})");
  EXPECT_THAT(refusal([&] { loadBopModels(folder.path("models")); }), HasSubstr("obj_000007.ply"));
  folder.write("models/models_info.json", R"({"1": {"name": "x"}})");
  EXPECT_THAT(refusal([&] { loadBopModels(folder.path("models")); }),
              HasSubstr("object '1': 'diameter' is missing"));

  folder.write("models/models_info.json", R"({"1": {"diameter": 10, "symmetries_discrete": [[1, 2]]}})");
  EXPECT_THAT(refusal([&] { loadBopModels(folder.path("models")); }),
              HasSubstr("has 2 numbers, 16 expected"));
  folder.write("dev/000001/scene_gt_info.json", R"({"0": [], "3": []})");
  EXPECT_THAT(refusal([&] { loadBopSplit(folder.path(), "dev"); }),
              HasSubstr("does not list the same objects"));
  folder.write("dev/000001/scene_gt_info.json", "{");
  EXPECT_THAT(refusal([&] { loadBopSplit(folder.path(), "dev"); }), HasSubstr("not valid JSON"));
}

TEST(Dataset, UnreadableImagesAreNamed) {
  TempFolder folder;
  writeSmallDataset(folder);
  folder.write("dev/000001/gray/000000.png", "not a picture");
  std::filesystem::remove(folder.path("dev/000001/gray/000003.png"));
  const BopSplit split = loadBopSplit(folder.path(), "dev");
  EXPECT_THAT(refusal([&] { loadBopImage(split.images[0]); }), HasSubstr("000000.png: cannot be read"));
  EXPECT_THAT(refusal([&] { loadBopImage(split.images[1]); }), HasSubstr("scene 1, image 3: no image file"));
  BopImage skewed = split.images[0];
  skewed.intrinsics(0, 1) = 2;
  EXPECT_THAT(refusal([&] { bopCamera(skewed, 640, 480); }), HasSubstr("skew"));
}

}  // namespace
}  // namespace monocular_eye_hand
