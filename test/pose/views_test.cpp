// Circles and corners: poses from one feature.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "monocular_eye_hand/pose/circle_pose.h"
#include "monocular_eye_hand/pose/corner_pose.h"
#include "pose/real_roots.h"
#include "support/camera.h"
#include "support/random.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The image of a circle, from its cone: p on the circle's plane, |p - centre| = radius.
Ellipse imageOf(const CirclePose& circle, double radius, const Camera& camera) {
  // p = t x with t = n.c / n.x: |(n.c) x - (n.x) c|^2 = r^2 (n.x)^2
  const double h = circle.normal.dot(circle.centre);
  const Matrix3d m = h * Matrix3d::Identity() - circle.centre * circle.normal.transpose();
  const Matrix3d cone = m.transpose() * m - radius * radius * circle.normal * circle.normal.transpose();
  Matrix3d back;  // pixel to ray
  back << 1 / camera.fx, 0, -camera.cx / camera.fx, 0, 1 / camera.fy, -camera.cy / camera.fy, 0, 0, 1;
  const EllipseFromConic e = ellipseFromConic(back.transpose() * cone * back);
  EXPECT_TRUE(e.valid);
  return e.ellipse;
}

double error(const CirclePose& a, const CirclePose& b) {
  return std::max((a.normal - b.normal).norm(), (a.centre - b.centre).norm() / b.centre.norm());
}

CirclePose randomCircle(Random& random, double distance, double tilt) {
  CirclePose c;
  c.centre = Vector3d(uniform(random, -0.5, 0.5), uniform(random, -0.4, 0.4), 1).normalized() * distance;
  const Vector3d sight = -c.centre.normalized();
  c.normal = expSO3(tilt * sight.unitOrthogonal()) * sight;
  c.normal = expSO3(uniform(random, 0, 2 * M_PI) * sight) * c.normal;
  return c;
}

TEST(CirclePose, KnownSolutions) {
  std::ifstream file(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/test/pose/data/circle_pose.txt");
  ASSERT_TRUE(file);

  std::string line;
  int circles = 0;
  while (std::getline(file, line)) {
    if (line[0] == '#') continue;
    std::istringstream numbers(line);
    Camera camera = unevenCamera();
    Ellipse e;
    double radius;
    CirclePose expected[2];
    numbers >> camera.fx >> camera.fy >> camera.cx >> camera.cy >> radius;
    numbers >> e.centre[0] >> e.centre[1] >> e.a >> e.b >> e.angle;
    for (CirclePose& c : expected) {
      for (int i = 0; i < 3; ++i) numbers >> c.normal[i];
      for (int i = 0; i < 3; ++i) numbers >> c.centre[i];
      c.centre *= 1e-3;
    }
    ASSERT_TRUE(numbers);
    ++circles;
    const CirclePoses found = circlePoses(e, camera, 1e-3 * radius);
    ASSERT_EQ(found.count, 2);
    for (const CirclePose& c : expected)
      EXPECT_LT(std::min(error(found.pose[0], c), error(found.pose[1], c)), 1e-8) << "circle " << circles;
  }

  EXPECT_EQ(circles, 20);
}

TEST(CirclePose, RandomCirclesOffAxis) {
  Random random(11);
  const Camera camera = unevenCamera();

  for (int i = 0; i < 5000; ++i) {
    const double radius = uniform(random, 0.005, 0.1), tilt = uniform(random, 5, 80) * M_PI / 180;
    const CirclePose truth = randomCircle(random, uniform(random, 3, 40) * radius, tilt);
    const CirclePoses found = circlePoses(imageOf(truth, radius, camera), camera, radius);
    ASSERT_EQ(found.count, 2);
    EXPECT_LT(std::min(error(found.pose[0], truth), error(found.pose[1], truth)), 1e-8) << "tilt " << tilt;
    double tilts[2];
    for (int k = 0; k < 2; ++k) {
      const CirclePose& c = found.pose[k];
      EXPECT_NEAR(c.normal.norm(), 1, 1e-14);
      EXPECT_LT(c.normal.dot(c.centre), 0);
      EXPECT_GT(c.centre.z(), 0);
      tilts[k] = std::acos(-c.normal.dot(c.centre.normalized()));
      // The other solution is no less a circle of this image.
      const Ellipse again = imageOf(c, radius, camera), first = imageOf(truth, radius, camera);
      EXPECT_LT((again.centre - first.centre).norm(), 1e-6);
      EXPECT_NEAR(again.a, first.a, 1e-6);
      EXPECT_NEAR(again.b, first.b, 1e-6);
    }
    EXPECT_NEAR(tilts[0], tilts[1], 1e-7);
    EXPECT_LE(found.pose[0].normal.y(), found.pose[1].normal.y());
  }
}

TEST(CirclePose, HeadOnBothAgree) {
  Random random(12);
  const Camera camera = unevenCamera();
  for (int i = 0; i < 500; ++i) {
    const CirclePose truth = randomCircle(random, uniform(random, 0.2, 2), 0);
    const CirclePoses found = circlePoses(imageOf(truth, 0.03, camera), camera, 0.03);
    ASSERT_EQ(found.count, 2);
    for (const CirclePose& c : found.pose) EXPECT_LT(error(c, truth), 1e-5);  // tilt ~ sqrt(rounding)
  }
  // On the axis with square pixels a circle's image is a circle.
  Camera square = camera;
  square.fy = square.fx;
  const CirclePoses found = circlePoses({{square.cx, square.cy}, 60, 60, 0}, square, 0.05);
  ASSERT_EQ(found.count, 2);
  for (const CirclePose& c : found.pose)
    EXPECT_LT(error(c, {Vector3d(0, 0, 0.5), -Vector3d::UnitZ()}), 1e-12);
}

TEST(CirclePose, ScalesWithTheRadius) {
  Random random(13);
  const Camera camera = unevenCamera();
  const Ellipse image = imageOf(randomCircle(random, 0.7, 0.6), 0.04, camera);
  const CirclePoses one = circlePoses(image, camera, 0.04), ten = circlePoses(image, camera, 0.4);
  for (int k = 0; k < 2; ++k) {
    EXPECT_LT((ten.pose[k].centre - 10 * one.pose[k].centre).norm(), 1e-12);
    EXPECT_LT((ten.pose[k].normal - one.pose[k].normal).norm(), 1e-14);
  }
}

TEST(CirclePose, BadEllipsesGiveNone) {
  const Camera camera = unevenCamera();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(circlePoses(Ellipse(), camera, 0.03).count, 0);
  EXPECT_EQ(circlePoses({{300, 200}, 30, 0, 0}, camera, 0.03).count, 0);
  EXPECT_EQ(circlePoses({{300, 200}, 30, 20, 0}, camera, 0).count, 0);
  EXPECT_EQ(circlePoses({{nan, 200}, 30, 20, 0}, camera, 0.03).count, 0);
  EXPECT_EQ(circlePoses({{300, 200}, 30, 20, nan}, camera, 0.03).count, 0);
  EXPECT_EQ(circlePoses({{300, 200}, nan, 20, 0}, camera, 0.03).count, 0);
  EXPECT_EQ(circlePoses({{300, 200}, 30, 20, 0}, camera, nan).count, 0);
}

struct CornerView {
  CornerObservation seen;
  Matrix3d truth;
};

CornerView view(Random& random, const Matrix3d& directions) {
  CornerView v;
  for (;;) {
    v.truth = randomRotation(random);
    v.seen.corner = Vector3d(uniform(random, -0.4, 0.4), uniform(random, -0.4, 0.4), 1).normalized();
    const Vector3d at = v.seen.corner * uniform(random, 2, 20);
    double min_angle = 1;  // edges seen end-on or on one line leave the problem undefined
    for (int i = 0; i < 3; ++i) {
      const Vector3d end = at + v.truth * directions.col(i) * uniform(random, 0.3, 1);
      v.seen.far_points.col(i) = end.normalized();
      min_angle = std::min(min_angle, std::abs(v.seen.corner.cross(v.truth * directions.col(i)).norm()));
    }
    if (min_angle > 0.05) return v;
  }
}

double nearest(const std::vector<Matrix3d>& rotations, const Matrix3d& truth) {
  double best = std::numeric_limits<double>::infinity();
  for (const Matrix3d& r : rotations) best = std::min(best, (r - truth).norm());
  return best;
}

void expectOnObservedSide(const CornerObservation& seen, const Matrix3d& directions,
                          const Matrix3d& rotation) {
  EXPECT_NEAR(rotation.determinant(), 1, 1e-12);
  for (int i = 0; i < 3; ++i) {
    const Vector3d far = seen.far_points.col(i), edge = rotation * directions.col(i);
    EXPECT_LT(std::abs(edge.dot(seen.corner.cross(far).normalized())), 1e-6);
    EXPECT_GT(edge.dot(far - seen.corner * seen.corner.dot(far)), 0);
  }
}

TEST(CornerPose, RandomCorners) {
  Random random(14);
  int solutions = 0;
  for (int i = 0; i < 3000; ++i) {
    Matrix3d directions;
    do {
      for (int k = 0; k < 3; ++k) directions.col(k) = randomDirection(random);
    } while (std::abs(directions.determinant()) < 0.1);
    const CornerView v = view(random, directions);
    const std::vector<Matrix3d> found = cornerRotations(v.seen, directions);
    ASSERT_LE(found.size(), 4u);
    ASSERT_LT(nearest(found, v.truth), 1e-6) << "draw " << i;
    solutions += int(found.size());
    for (const Matrix3d& r : found) expectOnObservedSide(v.seen, directions, r);
  }
  EXPECT_GT(solutions, 3300);
}

TEST(CornerPose, RightAngledAndPartlyRightAngledCorners) {
  Random random(15);
  Matrix3d box = Matrix3d::Identity(), mirrored = box, wedge;
  mirrored.col(2) = -mirrored.col(2);
  wedge << 1, 0, std::sqrt(0.5), 0, 1, 0, 0, 0, std::sqrt(0.5);
  for (const Matrix3d& directions : {box, mirrored, wedge})
    for (int i = 0; i < 2000; ++i) {
      const CornerView v = view(random, directions);
      const std::vector<Matrix3d> found = cornerRotations(v.seen, directions);
      ASSERT_LT(nearest(found, v.truth), 1e-5) << "draw " << i;
      for (const Matrix3d& r : found) expectOnObservedSide(v.seen, directions, r);
    }
}

TEST(CornerPose, CubeAlongItsDiagonal) {
  // The symmetric Y: all three edges at the same angle to the line of sight.
  Random random(16);
  const Vector3d diagonal = Vector3d::Ones().normalized();
  for (const double sign : {-1.0, 1.0}) {
    const Vector3d sight(0.1, -0.2, 1);
    CornerView v;
    v.seen.corner = sight.normalized();
    v.truth = Eigen::Quaterniond::FromTwoVectors(diagonal, sign * sight).toRotationMatrix();
    for (int i = 0; i < 3; ++i) v.seen.far_points.col(i) = (5 * v.seen.corner + v.truth.col(i)).normalized();
    const std::vector<Matrix3d> found = cornerRotations(v.seen, Matrix3d::Identity());
    EXPECT_LT(nearest(found, v.truth), 1e-6);
    for (const Matrix3d& r : found) expectOnObservedSide(v.seen, Matrix3d::Identity(), r);
  }
}

TEST(CornerPose, DepthFromOneLength) {
  Random random(17);
  for (int i = 0; i < 500; ++i) {
    const CornerView v = view(random, Matrix3d::Identity());
    const double depth = uniform(random, 1, 5), length = uniform(random, 0.1, 0.5);
    const Vector3d edge = v.truth.col(0), end = (depth * v.seen.corner + length * edge).normalized();
    EXPECT_NEAR(cornerDepth(v.seen.corner, end, edge, length), depth, 1e-9 * depth);
    EXPECT_EQ(cornerDepth(v.seen.corner, end, -edge, length), 0);
  }
  EXPECT_EQ(cornerDepth(Vector3d::UnitZ(), Vector3d::UnitZ(), Vector3d::UnitZ(), 1), 0);
}

TEST(CornerPose, DegenerateInputGivesNone) {
  Random random(18);
  const CornerView v = view(random, Matrix3d::Identity());
  CornerObservation bad = v.seen;
  bad.far_points.col(1) = bad.corner;
  EXPECT_TRUE(cornerRotations(bad, Matrix3d::Identity()).empty());
  bad = v.seen;
  bad.far_points(0, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(cornerRotations(bad, Matrix3d::Identity()).empty());
  Matrix3d same = Matrix3d::Identity();
  same.col(1) = same.col(0);
  EXPECT_TRUE(cornerRotations(v.seen, same).empty());
}

TEST(RealRoots, SimpleDoubleAndNone) {
  const auto roots = [](const Quartic& p) {
    const RealRoots r = realRoots(p, -1, 1);
    return std::vector<double>(r.begin(), r.end());
  };
  const std::vector<double> simple = roots({0.1875, 0.21875, -1.9375, 1, 1});  // 0.5, -0.25, 0.75 and -2
  ASSERT_EQ(simple.size(), 3u);
  EXPECT_NEAR(simple[0], -0.25, 1e-14);
  EXPECT_NEAR(simple[1], 0.5, 1e-14);
  EXPECT_NEAR(simple[2], 0.75, 1e-14);
  const std::vector<double> twice = roots({0.0625, 0, -0.5, 0, 1});  // (x^2 - 1/4)^2
  ASSERT_EQ(twice.size(), 2u);
  EXPECT_NEAR(twice[0], -0.5, 1e-7);
  EXPECT_NEAR(twice[1], 0.5, 1e-7);
  EXPECT_TRUE(roots({1, 0, 1, 0, 1}).empty());
  EXPECT_EQ(roots({0.2, 1, 0, 0, 0}), std::vector<double>{-0.2});
}

}  // namespace
}  // namespace monocular_eye_hand
