#include "monocular_eye_hand/simulation/cell/motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

using namespace monocular_eye_hand;

namespace {

JointVector ready() { return (JointVector() << 0, M_PI / 2, -M_PI / 2, 0, 0, 0).finished(); }

CellPathPoint point(double time, const JointVector& positions, double velocity = NAN) {
  CellPathPoint out;
  out.time = time;
  out.positions = positions;
  if (!std::isnan(velocity)) out.velocities.assign(6, velocity);
  return out;
}

JointVector shifted(double joint1) {
  JointVector q = ready();
  q[0] += joint1;
  return q;
}

}  // namespace

TEST(CellMotion, FollowsLinesWithoutVelocities) {
  JointMotion motion({}, ready());
  motion.command({point(1, shifted(0.4)), point(2, shifted(0.2))});
  motion.advance(0.5);
  EXPECT_NEAR(motion.positions()[0], 0.2, 1e-12);
  EXPECT_NEAR(motion.velocities()[0], 0.4, 1e-12);
  motion.advance(1.0);
  EXPECT_NEAR(motion.positions()[0], 0.3, 1e-12);
  EXPECT_TRUE(motion.moving());
  EXPECT_TRUE(motion.advance(1.0).empty());
  EXPECT_EQ(motion.positions()[0], shifted(0.2)[0]);
  EXPECT_FALSE(motion.moving());
  EXPECT_EQ(motion.velocities().norm(), 0);
}

TEST(CellMotion, FollowsCubicsAndQuintics) {
  JointMotion motion({}, ready());
  motion.command({point(2, shifted(0.6), 0)});
  motion.advance(0.5);  // s = 1/4: 3 s^2 - 2 s^3 = 5/32
  EXPECT_NEAR(motion.positions()[0], 0.6 * 5 / 32, 1e-12);
  motion.advance(0.5);
  EXPECT_NEAR(motion.velocities()[0], 1.5 * 0.6 / 2, 1e-12);
  CellPathPoint a = point(0, ready(), 0), b = point(1, shifted(0.3), 0);
  a.accelerations = b.accelerations = std::vector<double>(6, 0.0);
  JointVector q, v;
  evaluatePath({a, b}, 0.25, &q, &v);  // 10 s^3 - 15 s^4 + 6 s^5
  EXPECT_NEAR(q[0], 0.3 * (10.0 / 64 - 15.0 / 256 + 6.0 / 1024), 1e-12);
  EXPECT_NEAR(v[0], 0.3 * (30.0 / 16 - 60.0 / 64 + 30.0 / 256), 1e-12);
}

TEST(CellMotion, ANewCommandStartsWhereTheArmIs) {
  JointMotion motion({}, ready());
  motion.command({point(2, shifted(0.6), 0)});
  motion.advance(1.0);
  const double p = motion.positions()[0], v = motion.velocities()[0];
  motion.command({point(1, shifted(0.5), 0)});
  motion.advance(0.001);
  EXPECT_NEAR(motion.positions()[0], p + 0.001 * v, 1e-5);
  EXPECT_NEAR(motion.velocities()[0], v, 5e-3);
  motion.advance(1.0);
  EXPECT_NEAR(motion.positions()[0], shifted(0.5)[0], 1e-12);
}

TEST(CellMotion, AnEmptyCommandStopsAtTheDeceleration) {
  const Puma560Options arm;
  JointMotion motion(arm, ready());
  motion.command({point(4, shifted(1.6))});
  motion.advance(1.0);
  const double p = motion.positions()[0], v = motion.velocities()[0], brake = arm.joints[0].acceleration;
  ASSERT_NEAR(v, 0.4, 1e-12);
  motion.command({});
  for (int k = 0; k < 400 && motion.moving(); ++k) EXPECT_TRUE(motion.advance(0.01).empty());
  EXPECT_FALSE(motion.moving());
  EXPECT_NEAR(motion.positions()[0], p + v * v / (2 * brake), 1e-9);
}

TEST(CellMotion, ClipsAtTheLimitsAndSaysSo) {
  const Puma560Options arm;
  JointMotion fast(arm, ready());
  fast.command({point(0.1, shifted(1.0))});
  const auto speeding = fast.advance(0.05);
  ASSERT_EQ(speeding.size(), 1u);
  EXPECT_EQ(speeding[0].joint, 0);
  EXPECT_EQ(speeding[0].kind, LimitViolation::Kind::kVelocity);
  EXPECT_NEAR(speeding[0].wanted, 10, 1e-9);
  EXPECT_NEAR(fast.positions()[0], 0.05 * arm.joints[0].velocity, 1e-12);
  for (int k = 0; k < 100 && fast.moving(); ++k) fast.advance(0.05);
  EXPECT_NEAR(fast.positions()[0], 1.0, 1e-12);  // late, but there

  JointMotion far(arm, ready());
  const double beyond = arm.joints[0].upper + 0.2;
  far.command({point(10, shifted(beyond))});
  bool reported = false;
  for (int k = 0; k < 250; ++k)
    for (const LimitViolation& v : far.advance(0.05))
      reported = reported || (v.kind == LimitViolation::Kind::kPosition && v.joint == 0);
  EXPECT_TRUE(reported);
  EXPECT_FALSE(far.moving());
  EXPECT_EQ(far.positions()[0], arm.joints[0].upper);
}

TEST(CellMotion, RefusesBrokenCommands) {
  JointMotion motion({}, ready());
  EXPECT_THROW(motion.command({point(1, ready()), point(1, ready())}), BadInput);
  EXPECT_THROW(motion.command({point(-1, ready())}), BadInput);
  EXPECT_THROW(motion.command({point(1, JointVector::Constant(NAN))}), BadInput);
  CellPathPoint five = point(1, ready());
  five.velocities.assign(5, 0.0);
  EXPECT_THROW(motion.command({five}), BadInput);
  EXPECT_FALSE(motion.moving());
  EXPECT_THROW(JointMotion({}, JointVector::Constant(9)), BadInput);
}
