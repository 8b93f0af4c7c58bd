#include "monocular_eye_hand/simulation/cell/camera.h"
#include "monocular_eye_hand/simulation/render/render.h"

#include <opencv2/imgproc.hpp>

#include "cell_world.h"

using namespace monocular_eye_hand;

namespace {

CellOptions looking() {
  CellOptions options;
  options.start_joints = lookJoints();
  return options;
}

bool same(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

}  // namespace

TEST(CellCamera, ShowsTheSceneAsRenderSceneDoes) {
  CellOptions options = looking();
  options.camera.noise_sigma = 0;
  options.camera.shot_noise = 0;
  options.camera.exposure = 1.1;
  options.lights.resize(1);
  // The arm's shadow falls aside.
  options.lights[0].x = 2;
  options.lights[0].y = -2;
  options.lights[0].radius = 0.02;
  options.lights[0].intensity = 6;

  WorkCell cell = makeCell(options);
  const CellImage image = CellCamera(cell, 1).capture(cell);

  Scene scene = cell.scene().scene;
  scene.world_from_camera = cell.scene().base_from_table.inverse() * image.base_from_camera;
  RenderOptions render;
  render.noise_sigma = 0;
  render.shot_noise = 0;
  render.blur_sigma = options.camera.blur_sigma;
  render.exposure = 1.1;
  const RenderedImage reference = renderScene(scene, cell.scene().camera, render);

  int others = 0, deeper = 0;
  for (int y = 0; y < image.ids.rows; ++y)
    for (int x = 0; x < image.ids.cols; ++x) {
      const short a = image.ids.at<short>(y, x), b = reference.ids.at<short>(y, x);
      if (a != b) {
        ++others;
        continue;
      }
      deeper += std::abs(image.depth.at<float>(y, x) - reference.depth.at<float>(y, x)) > 2e-4f;
    }

  const int pixels = int(image.ids.total());
  EXPECT_LT(others, pixels / 1000);
  EXPECT_LT(deeper, pixels / 2000);
  cv::Mat difference;
  cv::absdiff(image.grey, reference.grey, difference);
  EXPECT_LT(cv::mean(difference)[0], 1.0);
  EXPECT_LT(cv::countNonZero(difference > 20), pixels / 100);
}

TEST(CellCamera, LooksAtTheWholeFrameAndEveryPart) {
  WorkCell cell = makeCell(looking());
  const CellImage image = CellCamera(cell).capture(cell);
  const cv::Rect inside(10, 10, image.ids.cols - 20, image.ids.rows - 20);
  for (int object = 0; object < 4; ++object) {
    const cv::Mat1b mask = image.ids == object;
    EXPECT_GT(cv::countNonZero(mask), 2500) << object;
    EXPECT_EQ((cv::boundingRect(mask) & inside).area(), cv::boundingRect(mask).area()) << object;
  }
  EXPECT_NEAR((cell.baseFromCamera().translation - Eigen::Vector3d(0.55, 0, 0.31)).norm(), 0.5, 0.03);
  EXPECT_EQ(image.time, cell.time());
}

TEST(CellCamera, ThreadsAndRunsDoNotChangeTheImage) {
  CellOptions options = looking();
  WorkCell cell = makeCell(options), again = makeCell(options);
  CellCamera one(cell, 1), three(cell, 3), other(again, 2);
  const CellImage first = one.capture(cell);
  EXPECT_TRUE(same(first.grey, three.capture(cell).grey));
  EXPECT_TRUE(same(first.grey, other.capture(again).grey));
  EXPECT_TRUE(same(first.grey, one.capture(cell).grey));
  cell.advance(0.1);
  EXPECT_TRUE(same(first.grey, one.capture(cell).grey));  // the noise is the state's, not the time's
}

TEST(CellCamera, FollowsWhatMoves) {
  WorkCell cell = makeCell(looking());
  CellCamera camera(cell, 2);
  const CellImage before = camera.capture(cell);
  JointVector turned = cell.joints();
  turned[0] += 0.1;
  moveTo(&cell, turned);
  const CellImage after = camera.capture(cell);
  EXPECT_GT(difference(before.base_from_camera, after.base_from_camera).norm(), 0.05);

  // A point of the frame appears where the pose and the camera say.
  const Rigid3 camera_from_frame = after.base_from_camera.inverse() * cell.truth()[0].base_from_object;
  int checked = 0;
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(-0.135, 0, 0.025), Eigen::Vector3d(0, 0.095, 0.025)}) {
    const Eigen::Vector3d in_camera = camera_from_frame * p;
    const Eigen::Vector2d uv = camera.camera().distort(camera.camera().project(in_camera));
    const cv::Point pixel(int(std::lround(uv.x())), int(std::lround(uv.y())));
    if (!cv::Rect({}, after.ids.size()).contains(pixel)) continue;
    ++checked;
    EXPECT_EQ(after.ids.at<short>(pixel), 0);
    EXPECT_NEAR(after.depth.at<float>(pixel), in_camera.z(), 1e-3);
  }
  EXPECT_GE(checked, 1);
}

TEST(CellCamera, RefusesAnotherCell) {
  WorkCell cell = makeCell(looking());
  CellOptions fewer = looking();
  fewer.objects.resize(2);
  WorkCell other = makeCell(fewer);
  EXPECT_THROW(CellCamera(cell, 1).capture(other), BadInput);
  EXPECT_THROW(CellCamera(cell, -1), BadInput);
}

TEST(CellCamera, DoesNotShowWhatWasTakenAway) {
  WorkCell cell = makeCell(looking());
  CellCamera camera(cell);
  const CellImage before = camera.capture(cell);
  cell.takeAway(cell.label(1));
  const CellImage after = camera.capture(cell);
  EXPECT_GT(cv::countNonZero(before.ids == 1), 500);
  EXPECT_EQ(cv::countNonZero(after.ids == 1), 0);
  cell.takeAway(cell.label(2));
  cell.takeAway(cell.label(3));
  CellOptions alone = looking();
  alone.objects.resize(1);
  const WorkCell frame = makeCell(alone);
  const CellImage expected = CellCamera(frame).capture(frame);
  cv::Mat difference;
  cv::absdiff(camera.capture(cell).grey, expected.grey, difference);
  EXPECT_LT(cv::mean(difference)[0], 3);  // but for noise: no shadow is left either
}
