#include "monocular_eye_hand/geometry/covariance.h"

#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

Rigid3 somewhere(double x) { return {expSO3({0.3 * x, -0.8, 0.5 + x}), {0.1 * x, -0.4, 0.7}}; }

TEST(Covariance, MotionsAgreeWithDifferences) {
  const Rigid3 a_from_b = somewhere(1), b_from_c = somewhere(2), z_from_a = somewhere(3);
  const Matrix6d offset = adjointOfTranslation(a_from_b.rotation * b_from_c.translation);
  const Matrix6d axes = adjointOfRotation(z_from_a.rotation);
  for (int k = 0; k < 6; ++k) {
    const Vector6d d = 1e-6 * Vector6d::Unit(k);
    EXPECT_LT(
        (difference(a_from_b * b_from_c, perturbed(a_from_b, d) * b_from_c) / 1e-6 - offset.col(k)).norm(),
        1e-5);
    EXPECT_LT(
        (difference(z_from_a * a_from_b, z_from_a * perturbed(a_from_b, d)) / 1e-6 - axes.col(k)).norm(),
        1e-5);
  }
}

TEST(Covariance, CarriedIsSymmetric) {
  Matrix6d root = Matrix6d::Identity();
  for (int k = 0; k < 36; ++k) root(k / 6, k % 6) += std::sin(5.0 * k);
  const Matrix6d c = propagate(adjointOfTranslation({0.1, 0.2, 0.3}), root * root.transpose());
  EXPECT_EQ(c, c.transpose());
  EXPECT_NO_THROW(requireCovariance(c, "it"));
}

TEST(Covariance, WhatIsNoneIsRefused) {
  Matrix6d c = Matrix6d::Zero();
  EXPECT_NO_THROW(requireCovariance(c, "zero"));
  c = Matrix6d::Identity() * 1e-9;
  c(5, 5) = 3.3;  // a free axis
  EXPECT_NO_THROW(requireCovariance(c, "free axis"));
  c(0, 0) = -1e-10;
  EXPECT_THROW(requireCovariance(c, "negative"), BadInput);
  c = Matrix6d::Identity();
  c(0, 1) = c(1, 0) = 1.5;  // correlation above 1
  EXPECT_THROW(requireCovariance(c, "correlation"), BadInput);
  c(0, 1) = 0;
  EXPECT_THROW(requireCovariance(c, "asymmetric"), BadInput);
  c(1, 0) = INFINITY;
  EXPECT_THROW(requireCovariance(c, "infinite"), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
