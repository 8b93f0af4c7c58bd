#include "monocular_eye_hand/simulation/scenes/random_picture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/core.hpp>

#include "lowest.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/render/render.h"

using namespace monocular_eye_hand;

namespace {

NamedMesh block(const std::string& name, double size) {
  return {name, std::make_shared<Mesh>(boxMesh({size, 0.6 * size, 0.4 * size}))};
}

// From 25 to 200 mm.
std::vector<NamedMesh> fiveParts() {
  return {block("pin", 0.02), block("nut", 0.03), block("shoe", 0.08), block("plate", 0.11),
          block("beam", 0.16)};
}

double diameterInPixels(const RandomPicture& picture, const SceneObject& object) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : object.mesh->vertices) box.extend(p);
  const Eigen::Vector3d middle =
      picture.scene.world_from_camera.inverse() * (object.world_from_object * box.center());
  return picture.camera.fx * box.diagonal().norm() / middle.norm();
}

}  // namespace

TEST(RandomPicture, PartsOfAllSizesAppearInUsefulSizes) {
  double min_diameter = 1e9, max_diameter = 0;
  std::map<std::string, int> seen;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    RandomPictureOptions options;
    options.scene.level = seed % 2 ? SceneLevel::kHard : SceneLevel::kEasy;
    const RandomPicture picture = randomPicture(fiveParts(), seed, options);
    ASSERT_FALSE(picture.scene.objects.empty());
    for (const SceneObject& object : picture.scene.objects) {
      if (object.model < 0) continue;
      min_diameter = std::min(min_diameter, diameterInPixels(picture, object));
      max_diameter = std::max(max_diameter, diameterInPixels(picture, object));
      seen[object.name]++;
    }
  }

  EXPECT_GT(min_diameter, 35);
  EXPECT_LT(min_diameter, 80);
  EXPECT_LT(max_diameter, 600);
  EXPECT_GT(max_diameter, 250);
  EXPECT_EQ(seen.size(), fiveParts().size());
}

TEST(RandomPicture, CameraIsDrawnWithinItsBounds) {
  RandomPictureOptions options;
  options.width = 1280;
  options.height = 720;
  double min_focal = 10, max_focal = 0;
  for (uint32_t seed = 0; seed < 40; ++seed) {
    const Camera camera = randomPicture(fiveParts(), seed, options).camera;
    EXPECT_EQ(camera.width, 1280);
    EXPECT_EQ(camera.height, 720);
    EXPECT_LE(std::abs(camera.cx - 639.5), 12);
    EXPECT_LE(std::abs(camera.cy - 359.5), 12);
    min_focal = std::min(min_focal, camera.fx / camera.width);
    max_focal = std::max(max_focal, camera.fx / camera.width);
  }
  EXPECT_GE(min_focal, 0.9);
  EXPECT_LT(min_focal, 1.0);
  EXPECT_LE(max_focal, 1.6);
  EXPECT_GT(max_focal, 1.5);
}

TEST(RandomPicture, ForeignPartsAreClutter) {
  RandomPictureOptions options;
  options.scene.foreign = {block("stranger", 0.09)};
  std::map<int, int> counts;
  for (uint32_t seed = 0; seed < 40; ++seed) {
    int strangers = 0;
    for (const SceneObject& object : randomPicture({block("shoe", 0.08)}, seed, options).scene.objects) {
      EXPECT_EQ(object.model < 0, object.name == "stranger");
      strangers += object.model < 0;
    }
    counts[strangers]++;
  }
  EXPECT_GT(counts[0], 0);
  EXPECT_GT(counts[1] + counts[2] + counts[3], 10);
  EXPECT_EQ(counts.rbegin()->first <= 3, true);
}

TEST(RandomPicture, PiledPartsTouchButDoNotSinkIn) {
  RandomPictureOptions options;
  options.scene.level = SceneLevel::kHard;
  options.scene.piled = 1;
  int raised = 0, leaning = 0;
  for (uint32_t seed = 0; seed < 10; ++seed)
    for (const SceneObject& object : randomPicture({block("shoe", 0.08)}, seed, options).scene.objects) {
      EXPECT_GT(lowest(object), -1e-6);
      if (object.model < 0) continue;
      raised += lowest(object) > 0.003;
      leaning += object.world_from_object.rotation.row(2).cwiseAbs().maxCoeff() < 0.999;
    }
  EXPECT_GT(raised, 5);
  EXPECT_GT(leaning, 5);
}

TEST(RandomPicture, SensorFollowsTheLevel) {
  RandomPictureOptions options;
  EXPECT_EQ(randomPicture(fiveParts(), 1, options).render.noise_sigma, 1);
  options.scene.level = SceneLevel::kHard;
  double min_sigma = 10, max_sigma = 0;
  for (uint32_t seed = 0; seed < 30; ++seed) {
    const RenderOptions render = randomPicture(fiveParts(), seed, options).render;
    EXPECT_EQ(render.noise_sigma, 3.5);
    min_sigma = std::min(min_sigma, render.blur_sigma);
    max_sigma = std::max(max_sigma, render.blur_sigma);
  }
  EXPECT_GE(min_sigma, 0.6);
  EXPECT_LT(min_sigma, 0.7);
  EXPECT_LE(max_sigma, 1.1);
  EXPECT_GT(max_sigma, 1.0);
}

TEST(RandomPicture, SameSeedSamePicture) {
  RandomPictureOptions options;
  options.scene.level = SceneLevel::kHard;
  options.scene.piled = 0.5;
  options.width = 160;
  options.height = 120;
  const auto render = [&](uint32_t seed) {
    const RandomPicture picture = randomPicture(fiveParts(), seed, options);
    return renderScene(picture.scene, picture.camera, picture.render).grey;
  };
  EXPECT_EQ(cv::norm(render(5), render(5), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(render(5), render(6), cv::NORM_INF), 20);
}

TEST(RandomPicture, SizesAreDrawnByWeight) {
  const std::vector<ImageSize> sizes{{640, 480, 3}, {1280, 720, 1}};
  int wide = 0;
  for (uint32_t seed = 0; seed < 400; ++seed) wide += drawSize(sizes, seed).width == 1280;
  EXPECT_GT(wide, 70);
  EXPECT_LT(wide, 130);
  EXPECT_THROW(drawSize({}, 1), BadInput);
  EXPECT_THROW(drawSize({{640, 480, 0}}, 1), BadInput);
}

TEST(RandomPicture, BadInputIsNamed) {
  RandomPictureOptions options;
  options.max_focal = 0.5;
  EXPECT_THROW(randomPicture(fiveParts(), 1, options), BadInput);
  options = {};
  options.scene.size.max_pixels = 10;
  EXPECT_THROW(randomPicture(fiveParts(), 1, options), BadInput);
  EXPECT_THROW(randomPicture({{"empty", nullptr}}, 1), BadInput);
}
