#include <gtest/gtest.h>

#include <random>

#include "monocular_eye_hand/geometry/error.h"
#include "scene.h"

namespace monocular_eye_hand {
namespace {

std::vector<JointVector> randomPath(std::mt19937_64* random, int corners) {
  const Puma560 arm;
  std::vector<JointVector> path;
  for (int n = 0; n < corners; ++n) {
    JointVector q;
    for (int i = 0; i < 6; ++i) {
      const JointLimit& limit = arm.options().joints[i];
      q[i] = std::uniform_real_distribution<double>(limit.lower, limit.upper)(*random);
    }
    path.push_back(q);
  }
  return path;
}

double distanceToPath(const std::vector<JointVector>& path, const JointVector& q) {
  double best = 1e9;
  for (size_t i = 0; i + 1 < path.size(); ++i) {
    const JointVector d = path[i + 1] - path[i];
    const double f = std::clamp((q - path[i]).dot(d) / d.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (path[i] + f * d - q).norm());
  }
  return best;
}

TEST(TimeParameterise, KeepsEveryLimitAndThePath) {
  const ToolArm arm = toolArm();
  std::mt19937_64 random(3);
  for (int n = 0; n < 40; ++n) {
    const std::vector<JointVector> path = randomPath(&random, 2 + n % 5);
    TimingOptions options;
    if (n % 2) {
      options.speed = 0.5;
      options.acceleration = 0.25;
      options.tool_speed = 0.2;
    }
    const Trajectory trajectory = timeParameterise(arm, path, {}, options);
    EXPECT_LT((trajectory.points.front().position - path.front()).norm(), 1e-9);
    EXPECT_LT((trajectory.points.back().position - path.back()).norm(), 1e-9);
    EXPECT_EQ(trajectory.points.front().velocity.norm(), 0);

    const int samples = 2000;
    const double dt = trajectory.duration() / samples;
    TrajectoryState last = trajectory.sample(0);
    for (int k = 0; k <= samples; ++k) {
      const TrajectoryState s = trajectory.sample(k * dt);
      for (int i = 0; i < 6; ++i) {
        const JointLimit& limit = arm.arm.options().joints[i];
        ASSERT_LE(std::abs(s.velocity[i]), options.speed * limit.velocity * (1 + 1e-6));
        ASSERT_LE(std::abs(s.acceleration[i]), options.acceleration * limit.acceleration * (1 + 1e-6));
        // No jumps between the pieces: what the samples differ by agrees with speed and acceleration.
        ASSERT_LE(std::abs(s.velocity[i] - last.velocity[i]), limit.acceleration * dt + 1e-6);
        ASSERT_LE(std::abs(s.position[i] - last.position[i]), limit.velocity * dt + 1e-6);
      }
      ASSERT_LE(arm.tcpVelocity(s.position, s.velocity).norm(), options.tool_speed * (1 + 1e-6));
      ASSERT_LE(distanceToPath(path, s.position), options.corner + 1e-6);
      ASSERT_TRUE(arm.arm.withinLimits(s.position, 1e-6));
      last = s;
    }
    EXPECT_LT(last.velocity.norm(), 1e-6) << "at rest at the end";
  }
}

TEST(TimeParameterise, OneLongEdgeTakesTheTrapezoidsTime) {
  const ToolArm arm = toolArm();
  JointVector a = lookingJoints(), b = a;
  b[5] += a[5] > 0 ? -3 : 3;
  const JointLimit& limit = arm.arm.options().joints[5];
  TimingOptions fast;
  fast.tool_speed = 10;
  const double best = 3 / limit.velocity + limit.velocity / limit.acceleration;
  EXPECT_NEAR(timeParameterise(arm, {a, b}, {}, fast).duration(), best, 1e-6);
}

TEST(TimeParameterise, StopsWhereTheCornerCannotBeCut) {
  const ToolArm arm = toolArm();
  JointVector a = lookingJoints(), b = a, c;
  b[0] += 0.5;
  c = b;
  c[1] += 0.3;
  PathTest test;  // only the path itself is free
  test.valid = [&](const JointVector& q) { return distanceToPath({a, b, c}, q) < 1e-7; };
  const Trajectory stopping = timeParameterise(arm, {a, b, c}, test),
                   cutting = timeParameterise(arm, {a, b, c}, {});
  EXPECT_GT(stopping.duration(), cutting.duration());

  double nearest = 1, slowest = 1;
  for (double t = 0; t <= stopping.duration(); t += 1e-3) {
    ASSERT_LT(distanceToPath({a, b, c}, stopping.sample(t).position), 1e-7);
    if ((stopping.sample(t).position - b).norm() > nearest) continue;
    nearest = (stopping.sample(t).position - b).norm();
    slowest = stopping.sample(t).velocity.norm();
  }
  EXPECT_LT(slowest, 0.02);
}

TEST(TimeParameterise, StraightToolStaysStraightInTime) {
  const ToolArm arm = toolArm();
  const Rigid3 from = arm.baseFromTcp(lookingJoints());
  const CartesianPath path = cartesianPath(arm, lookingJoints(), down(0.52, 0.1, 0.40));
  TimingOptions options;
  options.corner = 0.002;
  options.tool_speed = 0.1;
  const Trajectory trajectory = timeParameterise(arm, path.points, {}, options);
  const Eigen::Vector3d line = (down(0.52, 0.1, 0.40).translation - from.translation).normalized();
  for (double t = 0; t < trajectory.duration(); t += 0.003) {
    const Eigen::Vector3d off = arm.baseFromTcp(trajectory.sample(t).position).translation - from.translation;
    EXPECT_LT((off - line * line.dot(off)).norm(), 5e-4);
  }
  const double length = (down(0.52, 0.1, 0.40).translation - from.translation).norm();
  EXPECT_LT(trajectory.duration(), 1.3 * length / 0.1 + 0.5);
}

TEST(TimeParameterise, PointsGiveTheMotionToCubics) {
  const ToolArm arm = toolArm();
  std::mt19937_64 random(4);
  const Trajectory trajectory = timeParameterise(arm, randomPath(&random, 4), {});
  for (size_t i = 0; i + 1 < trajectory.points.size(); ++i) {
    const TrajectoryState &a = trajectory.points[i], &b = trajectory.points[i + 1];
    const double h = b.time_s - a.time_s;
    ASSERT_GT(h, 0);
    const JointVector middle = (a.position + b.position) / 2 + h / 8 * (a.velocity - b.velocity);
    EXPECT_LT((trajectory.sample(a.time_s + h / 2).position - middle).norm(), 1e-7);
  }
}

TEST(TimeParameterise, RefusesBadInput) {
  const ToolArm arm = toolArm();
  EXPECT_THROW(timeParameterise(arm, {}, {}), BadInput);
  EXPECT_THROW(timeParameterise(arm, {JointVector::Constant(NAN)}, {}), BadInput);
  EXPECT_THROW(timeParameterise(arm, {JointVector::Constant(4)}, {}), BadInput);
  EXPECT_THROW(Trajectory().sample(0), BadInput);
  EXPECT_EQ(timeParameterise(arm, {lookingJoints(), lookingJoints()}, {}).duration(), 0);
}

}  // namespace
}  // namespace monocular_eye_hand
