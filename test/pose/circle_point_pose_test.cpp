// Pose from a circle and a point of the object.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "circle_image.h"
#include "monocular_eye_hand/pose/circle_pose.h"
#include "relative_error.h"
#include "support/camera.h"
#include "support/random.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct View {
  CircleAndPoint object;
  Rigid3 truth;
  Ellipse ellipse;
  Vector2d uv;
};

View viewOf(const CircleAndPoint& object, const Rigid3& truth, const Camera& camera) {
  return {object, truth,
          imageOfCircle(truth * object.centre, truth.rotation * object.axis, object.radius, camera),
          camera.project(truth * object.point)};
}

/// `tilt` of the axis against the line of sight [rad].
View randomView(Random& random, const Camera& camera, double tilt) {
  CircleAndPoint object;
  object.radius = uniform(random, 0.01, 0.05);
  object.centre = 0.05 * randomDirection(random);
  object.axis = randomDirection(random);
  const Vector3d across = object.axis.cross(randomDirection(random)).normalized();
  object.point =
      object.centre + object.radius * (uniform(random, 1, 3) * across + uniform(random, -2, 2) * object.axis);
  const double x = uniform(random, -0.35, 0.35), y = uniform(random, -0.35, 0.35);
  const Vector3d sight = Vector3d(x, y, 1).normalized();
  const Vector3d normal = expSO3(tilt * sight.cross(randomDirection(random)).normalized()) * Vector3d(-sight);
  Rigid3 truth;
  truth.rotation = expSO3(uniform(random, 0, 2 * M_PI) * normal) *
                   Eigen::Quaterniond::FromTwoVectors(object.axis, normal).toRotationMatrix();
  truth.translation = sight * object.radius * uniform(random, 6, 40) - truth.rotation * object.centre;
  return viewOf(object, truth, camera);
}

CirclePointPoses solve(const View& v, const Camera& camera) {
  return circlePointPoses(v.ellipse, camera, v.object, v.uv);
}

TEST(CirclePointPose, TheTruthComesFirst) {
  Random random(41);
  const Camera camera = unevenCamera();
  for (int i = 0; i < 5000; ++i) {
    const View v = randomView(random, camera, uniform(random, 5, 85) * M_PI / 180);
    const CirclePointPoses found = solve(v, camera);
    ASSERT_EQ(found.count, 2);
    EXPECT_LT(relativeError(found.pose[0].camera_from_object, v.truth), 1e-9) << "draw " << i;
    EXPECT_LT(found.pose[0].error, 1e-9);
    EXPECT_LE(found.pose[0].error, found.pose[1].error);
  }
}

TEST(CirclePointPose, BothPosesShowTheCircle) {
  Random random(42);
  const Camera camera = unevenCamera();

  for (int i = 0; i < 1000; ++i) {
    const View v = randomView(random, camera, uniform(random, 10, 80) * M_PI / 180);
    const CirclePointPoses found = solve(v, camera);
    ASSERT_EQ(found.count, 2);
    for (const CirclePointPose& p : found.pose) {
      const Rigid3& pose = p.camera_from_object;
      EXPECT_LT((pose.rotation * pose.rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-13);
      EXPECT_GT(pose.rotation.determinant(), 0);
      const View again = viewOf(v.object, pose, camera);
      EXPECT_LT((again.ellipse.centre - v.ellipse.centre).norm(), 1e-7);
      EXPECT_NEAR(again.ellipse.a, v.ellipse.a, 1e-7);
      EXPECT_NEAR(again.ellipse.b, v.ellipse.b, 1e-7);
      const Vector3d point = pose * v.object.point, ray = camera.ray(v.uv);
      EXPECT_NEAR(p.error, std::atan2(point.cross(ray).norm(), point.dot(ray)), 1e-12);
    }
  }
}

TEST(CirclePointPose, NoOtherRollBringsThePointNearer) {
  Random random(43);
  const Camera camera = unevenCamera();
  for (int i = 0; i < 300; ++i) {
    View v = randomView(random, camera, uniform(random, 10, 80) * M_PI / 180);
    v.uv += (i % 2 == 0 ? 3 : 60) * Vector2d(normal(random), normal(random));  // off the ring
    const CirclePointPoses found = solve(v, camera);
    ASSERT_EQ(found.count, 2);
    for (const CirclePointPose& p : found.pose) {
      const Vector3d axis = p.camera_from_object.rotation * v.object.axis,
                     centre = p.camera_from_object * v.object.centre,
                     arm = p.camera_from_object * v.object.point - centre, ray = camera.ray(v.uv);
      for (int k = 1; k < 720; ++k) {
        const Vector3d point = centre + expSO3(k * M_PI / 360 * axis) * arm;
        EXPECT_GT(std::atan2(point.cross(ray).norm(), point.dot(ray)), p.error * (1 - 1e-9));
      }
    }
  }
}

TEST(CirclePointPose, GracefulTowardsHeadOn) {
  // The tilt is the square root of what is seen of it: at most half of the digits are lost.
  Random random(44);
  const Camera camera = unevenCamera();
  for (const double degrees : {0.0, 1e-4, 1e-2, 0.1, 1.0})
    for (int i = 0; i < 500; ++i) {
      const View v = randomView(random, camera, degrees * M_PI / 180);
      const CirclePointPoses found = solve(v, camera);
      ASSERT_EQ(found.count, 2);
      const double best = std::min(relativeError(found.pose[0].camera_from_object, v.truth),
                                   relativeError(found.pose[1].camera_from_object, v.truth));
      EXPECT_LT(best, degrees < 0.1 ? 1e-5 : 1e-8) << degrees;
    }
}

TEST(CirclePointPose, TurningTheImageTurnsThePose) {
  Random random(45);
  Camera camera = unevenCamera();
  camera.fy = camera.fx;

  for (int i = 0; i < 500; ++i) {
    const View v = randomView(random, camera, uniform(random, 10, 80) * M_PI / 180);
    const double angle = uniform(random, 0, 2 * M_PI);
    const Rigid3 turn{expSO3({0, 0, angle}), Vector3d::Zero()};
    const Vector2d middle(camera.cx, camera.cy);
    const Eigen::Rotation2Dd turn2(angle);
    View turned = v;
    turned.ellipse.centre = middle + turn2 * (v.ellipse.centre - middle);
    turned.ellipse.angle += angle;
    turned.uv = middle + turn2 * (v.uv - middle);
    const CirclePointPoses one = solve(v, camera), two = solve(turned, camera);
    ASSERT_EQ(one.count, 2);
    ASSERT_EQ(two.count, 2);
    for (size_t k = 0; k < 2; ++k)
      EXPECT_LT(relativeError(two.pose[k].camera_from_object, turn * one.pose[k].camera_from_object), 1e-7);
  }
}

TEST(CirclePointPose, NothingToFindIsAResult) {
  Random random(46);
  const Camera camera = unevenCamera();
  const View v = randomView(random, camera, 0.7);
  ASSERT_EQ(solve(v, camera).count, 2);

  View bad = v;
  bad.object.point = v.object.centre + 0.03 * v.object.axis;  // no roll to see
  EXPECT_EQ(solve(bad, camera).count, 0);
  bad = v;
  bad.object.point = v.object.centre;
  EXPECT_EQ(solve(bad, camera).count, 0);
  bad = v;
  bad.object.axis.setZero();
  EXPECT_EQ(solve(bad, camera).count, 0);
  bad = v;
  bad.object.radius = 0;
  EXPECT_EQ(solve(bad, camera).count, 0);
  bad = v;
  bad.ellipse.b = 0;
  EXPECT_EQ(solve(bad, camera).count, 0);

  const double numbers[] = {std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()};
  for (const double value : numbers) {
    bad = v;
    bad.uv.x() = value;
    EXPECT_EQ(solve(bad, camera).count, 0);
    bad = v;
    bad.object.point.y() = value;
    EXPECT_EQ(solve(bad, camera).count, 0);
    bad = v;
    bad.object.axis.y() = value;
    EXPECT_EQ(solve(bad, camera).count, 0);
    bad = v;
    bad.object.centre.z() = value;
    EXPECT_EQ(solve(bad, camera).count, 0);
    bad = v;
    bad.object.radius = value;
    EXPECT_EQ(solve(bad, camera).count, 0);
  }
}

}  // namespace
}  // namespace monocular_eye_hand
