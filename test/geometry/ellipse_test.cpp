#include "monocular_eye_hand/geometry/ellipse.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace monocular_eye_hand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

double value(const Matrix3d& conic, const Vector2d& uv) {
  const Vector3d p(uv.x(), uv.y(), 1);
  return p.dot(conic * p);
}

TEST(Ellipse, ConicThereAndBack) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    Ellipse e;
    e.centre = {uniform(random, -200, 2000), uniform(random, -200, 1200)};
    e.a = uniform(random, 3, 300);
    e.b = e.a * uniform(random, 0.05, 0.99);
    e.angle = uniform(random, -M_PI / 2, M_PI / 2);
    const Matrix3d conic = e.conic();
    EXPECT_NEAR(conic.norm(), 1, 1e-14);
    EXPECT_EQ((conic - conic.transpose()).norm(), 0);
    EXPECT_LT(value(conic, e.centre), 0);
    EXPECT_GT(value(conic, e.centre + Vector2d(1.01 * e.a, 1.01 * e.a)), 0);
    for (const double scale : {1.0, -3.0, 1e6}) {
      const EllipseFromConic back = ellipseFromConic(scale * conic);
      ASSERT_TRUE(back.valid);
      EXPECT_LT((back.ellipse.centre - e.centre).norm(), 1e-6);
      EXPECT_NEAR(back.ellipse.a, e.a, 1e-6 * e.a);
      EXPECT_NEAR(back.ellipse.b, e.b, 1e-6 * e.b);
      EXPECT_LT(std::abs(std::sin(back.ellipse.angle - e.angle)), 1e-5);
    }
  }
}

TEST(Ellipse, PointsLieOnItAndTurnFromUToV) {
  const Ellipse e{{100, 50}, 40, 20, 0.3};
  const Matrix3d conic = e.conic();
  for (int i = 0; i < 64; ++i) EXPECT_NEAR(value(conic, e.at(0.1 * i)), 0, 1e-12);
  EXPECT_LT((e.at(0) - Vector2d(100 + 40 * std::cos(0.3), 50 + 40 * std::sin(0.3))).norm(), 1e-12);
  EXPECT_LT((e.at(M_PI / 2) - Vector2d(100 - 20 * std::sin(0.3), 50 + 20 * std::cos(0.3))).norm(), 1e-12);
}

TEST(Ellipse, LongAxisFirst) {
  Matrix3d tall = Matrix3d::Zero();
  tall.diagonal() << 1 / 4.0, 1 / 100.0, -1;
  const EllipseFromConic e = ellipseFromConic(tall);
  ASSERT_TRUE(e.valid);
  EXPECT_NEAR(e.ellipse.a, 10, 1e-12);
  EXPECT_NEAR(e.ellipse.b, 2, 1e-12);
  EXPECT_NEAR(std::abs(std::sin(e.ellipse.angle)), 1, 1e-12);
}

TEST(Ellipse, OtherConicsAreRefused) {
  const auto diagonal = [](double a, double b, double c) {
    Matrix3d m = Matrix3d::Zero();
    m.diagonal() << a, b, c;
    return m;
  };
  EXPECT_TRUE(ellipseFromConic(diagonal(1, 1, -1)).valid);
  EXPECT_FALSE(ellipseFromConic(diagonal(1, -1, -1)).valid);  // hyperbola
  EXPECT_FALSE(ellipseFromConic(diagonal(1, 1, 1)).valid);    // imaginary
  EXPECT_FALSE(ellipseFromConic(diagonal(1, 1, 0)).valid);    // a point
  EXPECT_FALSE(ellipseFromConic(diagonal(1, 0, -1)).valid);   // two lines
  Matrix3d parabola = diagonal(1, 0, 0);
  parabola(1, 2) = parabola(2, 1) = -0.5;
  EXPECT_FALSE(ellipseFromConic(parabola).valid);
  EXPECT_FALSE(ellipseFromConic(Matrix3d::Zero()).valid);
  Matrix3d bad = diagonal(1, 1, -1);
  bad(0, 1) = std::nan("");
  EXPECT_FALSE(ellipseFromConic(bad).valid);
}

}  // namespace
}  // namespace monocular_eye_hand
