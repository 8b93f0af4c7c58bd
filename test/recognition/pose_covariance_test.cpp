#include "monocular_eye_hand/recognition/pose_covariance.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace monocular_eye_hand {
namespace {

Camera camera() {
  Camera c;
  c.width = 640, c.height = 480;
  c.fx = c.fy = 700, c.cx = 319.5, c.cy = 239.5;
  return c;
}

// The outlines of two squares of 10 cm, one 4 cm above the other: eight features of `per_edge` samples each.
struct Contour {
  Contour(const Rigid3& pose, int per_edge) {
    int group = 0;
    for (double z : {0.0, 0.04})
      for (int side = 0; side < 4; ++side, ++group) {
        const auto corner = [&](int k) {
          return Eigen::Vector3d((k + 1) % 4 < 2 ? -0.05 : 0.05, k % 4 < 2 ? -0.05 : 0.05, z);
        };
        const Eigen::Vector3d a = corner(side), b = corner(side + 1);
        const Eigen::Vector2d d = camera().project(pose * b) - camera().project(pose * a);
        for (int i = 0; i < per_edge; ++i) {
          const Eigen::Vector3d p = a + (i + 0.5) / per_edge * (b - a);
          matches.push_back(
              {p, camera().project(pose * p), Eigen::Vector2d(-d.y(), d.x()).normalized(), 0.3});
          groups.push_back(group);
        }
      }
  }
  Matrix6d covariance(const Rigid3& pose, const FreeAxis& axis = {}) const {
    return contourCovariance(pose, camera(), matches, groups, axis);
  }
  std::vector<LineMatch> matches;
  std::vector<int> groups;
};

Rigid3 pose() {
  Rigid3 p;
  p.rotation = expSO3({2.4, 0.2, 0.3});
  p.translation = {0.02, -0.01, 0.5};
  return p;
}

TEST(ContourCovariance, is_symmetric_positive_and_of_a_plausible_size) {
  const Matrix6d c = Contour(pose(), 20).covariance(pose());
  EXPECT_EQ(c, c.transpose());
  EXPECT_EQ(Eigen::LLT<Matrix6d>(c).info(), Eigen::Success);
  for (int i = 0; i < 2; ++i) {  // a fraction of a pixel: 0.7 mm each
    EXPECT_GT(std::sqrt(c(i, i)), 1e-5);
    EXPECT_LT(std::sqrt(c(i, i)), 7e-4);
  }
  EXPECT_GT(c(2, 2), c(0, 0)) << "depth is the least certain";
}

TEST(ContourCovariance, more_samples_of_the_same_features_do_not_make_it_vanish) {
  const double few = std::sqrt(Contour(pose(), 5).covariance(pose())(2, 2));
  const double many = std::sqrt(Contour(pose(), 20).covariance(pose())(2, 2));
  const double very_many = std::sqrt(Contour(pose(), 500).covariance(pose())(2, 2));
  EXPECT_LT(many, few);
  EXPECT_LT(very_many, many);
  EXPECT_GT(very_many, 0.3 * many) << "a feature as a whole is only so certain";
}

TEST(ContourCovariance, outliers_say_nothing) {
  Contour contour(pose(), 20);
  const Matrix6d clean = contour.covariance(pose());
  for (int i = 0; i < 50; ++i) {
    LineMatch far = contour.matches[size_t(i)];
    far.uv += 30 * far.normal;
    contour.matches.push_back(far);
    contour.groups.push_back(contour.groups[size_t(i)]);
  }
  EXPECT_LT((contour.covariance(pose()) - clean).norm(), 1e-12 * clean.norm());
}

TEST(ContourCovariance, without_matches_everything_is_open) {
  const Matrix6d c = contourCovariance(pose(), camera(), {}, {}, {});
  EXPECT_TRUE(c.allFinite());
  EXPECT_GT(c(0, 0), 0.5);
  EXPECT_GT(c(3, 3), 1);
}

TEST(ContourCovariance, the_turn_about_a_free_axis_is_open_and_nothing_else) {
  FreeAxis axis;
  axis.present = true;
  axis.point = {0.01, 0.02, 0};
  axis.direction = Eigen::Vector3d::UnitZ();
  const Contour contour(pose(), 20);
  const Matrix6d held = contour.covariance(pose(), axis), seen = contour.covariance(pose());
  const Eigen::Vector3d direction = pose().rotation * axis.direction;
  const auto about = [&](const Matrix6d& c) {
    return direction.dot(c.bottomRightCorner<3, 3>() * direction);
  };
  EXPECT_NEAR(about(held), M_PI * M_PI / 3, 0.01);
  EXPECT_LT(about(seen), 1e-3);
  const Eigen::Vector3d tilt = direction.unitOrthogonal();
  EXPECT_LT(tilt.dot(held.bottomRightCorner<3, 3>() * tilt), 1e-3);
  // The point on the axis stays where it is: its covariance is small, though the turn is open.
  const Eigen::Vector3d arm = pose() * axis.point - pose().translation;
  Eigen::Matrix<double, 3, 6> moves;
  moves << Eigen::Matrix3d::Identity(), -skew(arm);
  EXPECT_LT((moves * held * moves.transpose()).trace(), 1e-5);
}

}  // namespace
}  // namespace monocular_eye_hand
