#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "monocular_eye_hand/pose/refine.h"
#include "random_matches.h"
#include "support/camera.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Vector3d;

TEST(BestFour, WidestSpreadAndLeastUncertainty) {
  const Camera camera = unevenCamera();
  const Rigid3 pose{expSO3({0.3, 0.2, 0.1}), Vector3d(0, 0, 0.6)};
  std::vector<PointMatch> points;
  const auto add = [&](double x, double y, double z, double sigma) {
    PointMatch m;
    m.p_in_object = {x, y, z};
    m.uv = camera.project(pose * m.p_in_object);
    m.sigma = sigma;
    points.push_back(m);
  };
  for (int i = 0; i < 6; ++i) add(0.01 * std::cos(i), 0.01 * std::sin(i), 0.002 * i, 0.5);  // a tight bunch

  // 6..9, far apart
  add(0.1, 0.1, 0, 0.5);
  add(-0.1, 0.1, 0, 0.5);
  add(-0.1, -0.1, 0, 0.5);
  add(0.1, -0.1, 0, 0.5);
  // as far apart, but uncertain
  add(0.1, 0.1, 0, 5);
  add(-0.1, -0.1, 0, 5);
  EXPECT_EQ(bestFour(points, pose, camera), (std::vector<int>{6, 7, 8, 9}));

  // A wide point that does not fit `start` is uncertain too.
  points[10].sigma = 0.5;
  points[6].uv.x() += 8;
  EXPECT_EQ(bestFour(points, pose, camera), (std::vector<int>{7, 8, 9, 10}));
}

TEST(BestFour, PoseFromFourOfMany) {
  Random random(30);
  const Camera camera = unevenCamera();
  int good = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const Rigid3 truth = randomPose(random), start = perturbed(truth, randomStep(random, 0.01, 0.05));
    const auto exact = randomPoints(truth, camera, 12, 0, random);
    const RefinedPose found = poseFromBestFour(exact, start, camera);
    good += difference(truth, found.camera_from_object).norm() < 1e-6;
    EXPECT_TRUE(found.converged);
  }
  EXPECT_GE(good, 199);
}

TEST(BestFour, TooFewOrDegenerateGivesNone) {
  Random random(31);
  const Camera camera = unevenCamera();
  const Rigid3 truth = randomPose(random);
  auto points = randomPoints(truth, camera, 3, 0.2, random);
  EXPECT_TRUE(bestFour(points, truth, camera).empty());
  EXPECT_FALSE(poseFromBestFour(points, truth, camera).converged);
  for (int i = 0; i < 5; ++i) points.push_back(points[0]);  // three different points, repeated: still a pose
  EXPECT_EQ(bestFour(points, truth, camera).size(), 4u);
  std::vector<PointMatch> same(6, points[0]);
  EXPECT_TRUE(bestFour(same, truth, camera).empty());
  std::vector<PointMatch> row;
  for (int i = 0; i < 6; ++i) {
    PointMatch m = points[0];
    m.p_in_object = Vector3d(0.02 * i, 0.01 * i, 0);
    m.uv = camera.project(truth * m.p_in_object);
    row.push_back(m);
  }

  EXPECT_TRUE(bestFour(row, truth, camera).empty());
  for (PointMatch& m : points) m.uv.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(bestFour(points, truth, camera).empty());
}

}  // namespace
}  // namespace monocular_eye_hand
