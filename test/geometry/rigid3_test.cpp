#include "monocular_eye_hand/geometry/rigid3.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace monocular_eye_hand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class Rigid3Test : public ::testing::Test {
 protected:
  Vector3d vector() { return randomVector(random_); }
  Rigid3 pose() {
    const Vector3d axis = randomDirection(random_);
    return {expSO3(axis * std::abs(normal(random_))), vector()};
  }
  static double distance(const Rigid3& a, const Rigid3& b) {
    return (a.rotation - b.rotation).norm() + (a.translation - b.translation).norm();
  }
  Random random_{1};
};

TEST_F(Rigid3Test, GroupLaws) {
  for (int i = 0; i < 200; ++i) {
    const Rigid3 a = pose(), b = pose(), c = pose();
    EXPECT_LT(distance((a * b) * c, a * (b * c)), 1e-13);
    EXPECT_LT(distance(a * a.inverse(), Rigid3()), 1e-13);
    EXPECT_LT(distance(a.inverse() * a, Rigid3()), 1e-13);
    EXPECT_LT(distance(a * Rigid3(), a), 1e-15);
    EXPECT_LT(distance((a * b).inverse(), b.inverse() * a.inverse()), 1e-13);
    const Vector3d p = vector();
    EXPECT_LT(((a * b) * p - a * (b * p)).norm(), 1e-13);
    EXPECT_LT((a.inverse() * (a * p) - p).norm(), 1e-13);
  }
}

TEST_F(Rigid3Test, ConventionIsTargetFromSource) {
  // The tool stands at (1, 0, 0) of the base, turned by +90 degrees about z: its x axis is the base's y axis.
  const Rigid3 base_from_tool{expSO3({0, 0, M_PI / 2}), Vector3d(1, 0, 0)};
  EXPECT_LT((base_from_tool * Vector3d(2, 0, 0) - Vector3d(1, 2, 0)).norm(), 1e-15);
  EXPECT_LT((Matrix3d(base_from_tool.quaternion()) - base_from_tool.rotation).norm(), 1e-15);
}

TEST_F(Rigid3Test, SkewIsTheCrossProduct) {
  const Vector3d a = vector(), b = vector();
  EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-15);
  EXPECT_EQ((skew(a) + skew(a).transpose()).norm(), 0);
}

TEST_F(Rigid3Test, ExpAndLogAtEveryAngle) {
  const double angles[] = {0,   1e-300, 1e-15, 1e-12, 1e-9, 1e-7,        0.9e-4,      1.1e-4,       1e-3,
                           0.5, 1.5,    2.5,   3.1,   3.14, M_PI - 1e-5, M_PI - 1e-8, M_PI - 1e-12, M_PI};
  for (const double angle : angles)
    for (int i = 0; i < 50; ++i) {
      const Vector3d axis = vector().normalized(), w = angle * axis;
      const Matrix3d r = expSO3(w);
      EXPECT_LT((r * r.transpose() - Matrix3d::Identity()).norm(), 1e-14) << angle;
      EXPECT_NEAR(r.determinant(), 1, 1e-14);
      EXPECT_LT((r - Eigen::AngleAxisd(angle, axis).toRotationMatrix()).norm(), 1e-14) << angle;
      const Vector3d back = logSO3(r);
      EXPECT_LE(back.norm(), M_PI + 1e-15);
      EXPECT_NEAR(back.norm(), angle, 1e-14) << angle;
      const double error =
          M_PI - angle < 1e-7 ? std::min((back - w).norm(), (back + w).norm()) : (back - w).norm();
      EXPECT_LT(error, 1e-14 + 1e-7 * (angle > 3.141592)) << angle;
      EXPECT_LT((expSO3(back) - r).norm(), 1e-14) << angle;
    }

  // Half turns about the axes, where trace-based formulas divide zero by zero.
  for (int k = 0; k < 3; ++k) {
    Matrix3d half = -Matrix3d::Identity();
    half(k, k) = 1;
    EXPECT_LT((logSO3(half).cwiseAbs() - M_PI * Vector3d::Unit(k)).norm(), 1e-14);
  }
}

TEST_F(Rigid3Test, AngleBetween) {
  for (int i = 0; i < 100; ++i) {
    const Matrix3d a = pose().rotation;
    const double angle = 3.1 * i / 99;
    EXPECT_NEAR(angleBetween(a, a * expSO3(angle * vector().normalized())), angle, 1e-13);
  }
}

TEST_F(Rigid3Test, NearestRotation) {
  for (int i = 0; i < 100; ++i) {
    const Matrix3d r = pose().rotation;
    EXPECT_LT((nearestRotation(r) - r).norm(), 1e-14);
    EXPECT_LT((nearestRotation(3.7 * r) - r).norm(), 1e-14);
    Matrix3d noisy = r;
    for (int k = 0; k < 9; ++k) noisy(k) += 0.1 * normal(random_);
    const Matrix3d nearest = nearestRotation(noisy);
    EXPECT_NEAR(nearest.determinant(), 1, 1e-14);
    for (int k = 0; k < 20; ++k)  // no neighbour is nearer
      EXPECT_LE((nearest - noisy).norm(), (nearest * expSO3(0.05 * vector()) - noisy).norm());
    EXPECT_NEAR(nearestRotation(-r).determinant(), 1, 1e-14);  // a reflection
  }
}

TEST_F(Rigid3Test, PerturbedAndDifferenceAreInverse) {
  for (int i = 0; i < 200; ++i) {
    const Rigid3 a = pose(), b = pose();
    EXPECT_LT(distance(perturbed(a, difference(a, b)), b), 1e-13);
    Vector6d d;
    d << vector(), 3.0 * std::abs(std::sin(i)) * vector().normalized();
    EXPECT_LT((difference(a, perturbed(a, d)) - d).norm(), 1e-12);
    EXPECT_LT(difference(a, a).norm(), 1e-15);
  }
}

TEST_F(Rigid3Test, PerturbedTurnsAboutTheTargetsAxesInPlace) {
  const Rigid3 a{expSO3({0.3, -1.1, 0.4}), Vector3d(5, 6, 7)};
  Vector6d d = Vector6d::Zero();
  d[5] = M_PI / 2;  // about the target frame's z
  const Rigid3 b = perturbed(a, d);
  EXPECT_EQ((b.translation - a.translation).norm(), 0);
  const Vector3d x = a.rotation.col(0);
  EXPECT_LT((b.rotation.col(0) - Vector3d(-x.y(), x.x(), x.z())).norm(), 1e-15);
}

TEST_F(Rigid3Test, IsFinite) {
  Rigid3 a = pose();
  EXPECT_TRUE(a.isFinite());
  a.translation.y() = std::nan("");
  EXPECT_FALSE(a.isFinite());
  a = pose();
  a.rotation(1, 2) = INFINITY;
  EXPECT_FALSE(a.isFinite());
}

}  // namespace
}  // namespace monocular_eye_hand
