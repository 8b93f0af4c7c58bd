#include "monocular_eye_hand/pose/refine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "random_matches.h"
#include "support/camera.h"
#include "support/pose_matchers.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Samples on the edges of a box of 120 x 80 x 60 mm, as contour verification makes them.
std::vector<LineMatch> boxEdges(const Rigid3& pose, const Camera& camera, int per_edge, double noise,
                                Random& random) {
  const Vector3d half(0.06, 0.04, 0.03);
  std::vector<LineMatch> lines;

  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner)
      for (int i = 0; i < per_edge; ++i) {
        Vector3d p;
        p[axis] = half[axis] * (2.0 * (i + 0.5) / per_edge - 1);
        p[(axis + 1) % 3] = corner & 1 ? half[(axis + 1) % 3] : -half[(axis + 1) % 3];
        p[(axis + 2) % 3] = corner & 2 ? half[(axis + 2) % 3] : -half[(axis + 2) % 3];
        const Vector2d uv = camera.project(pose * p),
                       next = camera.project(pose * Vector3d(p + 1e-4 * Vector3d::Unit(axis)));
        const Vector2d along = (next - uv).normalized(), normal_of_line(-along.y(), along.x());
        LineMatch m;
        m.p_in_object = p;
        m.normal = normal_of_line;
        m.uv = uv + along * uniform(random, -5, 5) + normal_of_line * noise * normal(random);
        m.sigma = noise > 0 ? noise : 1;
        lines.push_back(m);
      }
  return lines;
}

TEST(Refine, DerivativesAgreeWithDifferences) {
  Random random(21);
  const Camera camera = unevenCamera();

  for (int draw = 0; draw < 200; ++draw) {
    const Rigid3 pose = randomPose(random);
    const LineMatch line = boxEdges(pose, camera, 1, 3, random)[draw % 12];
    const PointMatch point = randomPoints(pose, camera, 1, 3, random)[0];
    Vector6d of_line;
    Eigen::Matrix<double, 2, 6> of_point;
    lineResidual(pose, camera, line, &of_line);
    pointResidual(pose, camera, point, &of_point);
    for (int i = 0; i < 6; ++i) {
      const double h = 1e-6;
      const Rigid3 up = perturbed(pose, h * Vector6d::Unit(i)),
                   down = perturbed(pose, -h * Vector6d::Unit(i));
      EXPECT_NEAR((lineResidual(up, camera, line) - lineResidual(down, camera, line)) / (2 * h), of_line[i],
                  1e-3);
      const Vector2d slope =
          (pointResidual(up, camera, point) - pointResidual(down, camera, point)) / (2 * h);
      EXPECT_LT((slope - of_point.col(i)).norm(), 1e-3);  // of about 1000 px/m
    }
  }
}

TEST(Refine, ExactMatchesGiveTheExactPose) {
  Random random(22);
  const Camera camera = unevenCamera();
  for (int draw = 0; draw < 300; ++draw) {
    const Rigid3 truth = randomPose(random), start = perturbed(truth, randomStep(random, 0.005, 0.03));
    std::vector<LineMatch> lines;
    std::vector<PointMatch> points;
    if (draw % 3 != 0) lines = boxEdges(truth, camera, 5, 0, random);
    if (draw % 3 != 1) points = randomPoints(truth, camera, 8, 0, random);
    RefineOptions options;
    options.max_iterations = 20;
    const RefinedPose found = refinePose(start, camera, lines, points, options);
    EXPECT_TRUE(found.converged);
    EXPECT_TRUE(found.well_posed);
    EXPECT_THAT(found.camera_from_object, PoseNear(truth, 1e-05, 6e-07)) << "draw " << draw;
    EXPECT_LT(found.rms, 1e-5);
    EXPECT_NEAR(found.inliers, lines.size() + points.size(), 1e-6);
  }
}

TEST(Refine, StopsAtTheMinimum) {
  Random random(23);
  const Camera camera = unevenCamera();
  RefineOptions options;
  options.max_iterations = 50;
  options.robust_scale = 0;
  options.min_step = 1e-11;

  for (int draw = 0; draw < 50; ++draw) {
    const Rigid3 truth = randomPose(random);
    const auto lines = boxEdges(truth, camera, 3, 0.5, random);
    const auto points = randomPoints(truth, camera, 5, 0.5, random);
    const RefinedPose found =
        refinePose(perturbed(truth, randomStep(random, 0.005, 0.03)), camera, lines, points, options);

    Vector6d gradient = Vector6d::Zero();
    Matrix6d information = Matrix6d::Zero();
    for (const LineMatch& m : lines) {
      Vector6d j;
      gradient += lineResidual(found.camera_from_object, camera, m, &j) / (m.sigma * m.sigma) * j;
      information += j * j.transpose() / (m.sigma * m.sigma);
    }
    for (const PointMatch& m : points) {
      Eigen::Matrix<double, 2, 6> j;
      const Vector2d r = pointResidual(found.camera_from_object, camera, m, &j);
      gradient += j.transpose() * r / (m.sigma * m.sigma);
      information += j.transpose() * j / (m.sigma * m.sigma);
    }

    EXPECT_LT(information.ldlt().solve(gradient).norm(), 1e-8);
    EXPECT_TRUE(found.converged);
  }
}

TEST(Refine, OutliersDoNotBendThePose) {
  Random random(24);
  const Camera camera = unevenCamera();
  double robust = 0, plain = 0;
  for (int draw = 0; draw < 100; ++draw) {
    const Rigid3 truth = randomPose(random), start = perturbed(truth, randomStep(random, 0.004, 0.02));
    std::vector<LineMatch> lines = boxEdges(truth, camera, 5, 0.3, random);
    for (size_t i = 0; i < lines.size(); i += 4) lines[i].uv += lines[i].normal * uniform(random, 5, 40);
    RefineOptions options;
    options.max_iterations = 40;
    const RefinedPose found = refinePose(start, camera, lines, {}, options);
    EXPECT_LT(found.inliers, 46);
    robust = std::max(robust, difference(truth, found.camera_from_object).head<3>().norm());
    options.robust_scale = 0;
    plain +=
        difference(truth, refinePose(start, camera, lines, {}, options).camera_from_object).head<3>().norm();
  }

  EXPECT_LT(robust, 0.004);       // the worst of 100; a sigma is 0.5 to 1 mm in depth
  EXPECT_GT(plain / 100, 0.004);  // least squares, on average
}

/// Sample covariance of the errors, and the mean of the covariances reported.
struct Scatter {
  Matrix6d sample = Matrix6d::Zero(), reported = Matrix6d::Zero();
  double mahalanobis = 0;  // mean of e^T cov^-1 e; 6 when honest
};

Scatter scatter(int draws, double robust_scale, double outliers, bool points_too) {
  Random random(25);
  const Camera camera = unevenCamera();
  const Rigid3 truth{expSO3({0.4, -0.7, 0.3}), Vector3d(0.03, -0.02, 0.6)};
  Scatter s;
  RefineOptions options;
  options.robust_scale = robust_scale;
  options.max_iterations = 30;

  for (int draw = 0; draw < draws; ++draw) {
    std::vector<LineMatch> lines = boxEdges(truth, camera, 5, 0.4, random);
    std::vector<PointMatch> points;
    if (points_too) points = randomPoints(truth, camera, 6, 0.4, random);
    for (LineMatch& m : lines)
      if (uniform(random, 0, 1) < outliers) m.uv += m.normal * uniform(random, 4, 20);
    const RefinedPose found =
        refinePose(perturbed(truth, randomStep(random, 0.002, 0.01)), camera, lines, points, options);
    EXPECT_TRUE(found.well_posed);
    const Vector6d e = difference(truth, found.camera_from_object);
    s.sample += e * e.transpose() / draws;
    s.reported += found.covariance / draws;
    s.mahalanobis += e.dot(found.covariance.ldlt().solve(e)) / draws;
  }
  return s;
}

void expectAgreement(const Scatter& s, double tolerance) {
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(std::sqrt(s.reported(i, i) / s.sample(i, i)), 1, tolerance) << "axis " << i;
  // and in every other direction: the sample whitened by the reported covariance
  const Eigen::LLT<Matrix6d> llt(s.reported);
  const Matrix6d half = llt.matrixL().solve(s.sample), white = llt.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(0.5 * (white + white.transpose()));
  EXPECT_GT(eigen.eigenvalues()[0], 1 / ((1 + tolerance) * (1 + tolerance)));
  EXPECT_LT(eigen.eigenvalues()[5], (1 + tolerance) * (1 + tolerance));
}

TEST(Refine, CovarianceIsTheScatterLeastSquares) { expectAgreement(scatter(1500, 0, 0, true), 0.10); }
TEST(Refine, CovarianceIsTheScatterRobust) { expectAgreement(scatter(1500, 3, 0, true), 0.12); }
TEST(Refine, CovarianceIsTheScatterWithOutliers) {
  const Scatter s = scatter(1500, 3, 0.15, false);
  expectAgreement(s, 0.15);
  EXPECT_GT(s.mahalanobis, 5);
  EXPECT_LT(s.mahalanobis, 8);
}

TEST(Refine, CovarianceFollowsTheResidualsNotTheGuessedSigma) {
  Random random(26);
  const Camera camera = unevenCamera();
  const Rigid3 truth = randomPose(random);
  std::vector<LineMatch> lines = boxEdges(truth, camera, 8, 0.2, random);
  RefineOptions options;
  options.robust_scale = 0;
  const RefinedPose right = refinePose(truth, camera, lines, {}, options);
  for (LineMatch& m : lines) m.sigma = 1;
  const RefinedPose guessed = refinePose(truth, camera, lines, {}, options);
  EXPECT_LT((right.covariance - guessed.covariance).norm(), 1e-6 * right.covariance.norm());
  EXPECT_NEAR(right.rms, 0.2, 0.05);
  EXPECT_NEAR(guessed.rms, right.rms, 1e-9);
}

TEST(Refine, FreeAxisIsHeldAndMarked) {
  // A ring of points about an axis that does not pass through the object's origin.
  Random random(27);
  const Camera camera = unevenCamera();
  FreeAxis axis;
  axis.present = true;
  axis.point = Vector3d(0.02, 0.01, 0);
  axis.direction = Vector3d(0, 0.3, 2);

  for (int draw = 0; draw < 50; ++draw) {
    const Rigid3 truth = randomPose(random);
    const Vector3d d = axis.direction.normalized(), u = d.unitOrthogonal(), v = d.cross(u);
    std::vector<LineMatch> lines;
    for (int i = 0; i < 60; ++i) {  // two circles, seen as curves: only the normal counts
      const double angle = 2 * M_PI * i / 30, r = i < 30 ? 0.04 : 0.06;
      const Vector3d p = axis.point + (i < 30 ? 0.05 : 0.0) * d +
                         r * (std::cos(angle) * u + std::sin(angle) * v),
                     next = p + 1e-4 * (std::cos(angle) * v - std::sin(angle) * u);
      const Vector2d uv = camera.project(truth * p), along = (camera.project(truth * next) - uv).normalized();
      LineMatch m;
      m.p_in_object = p;
      m.uv = uv;
      m.normal = {-along.y(), along.x()};
      m.uv += 0.3 * normal(random) * m.normal;
      m.sigma = 0.3;
      lines.push_back(m);
    }

    const Rigid3 start = perturbed(truth, randomStep(random, 0.003, 0.02));
    RefineOptions options;
    options.max_iterations = 30;
    const RefinedPose found = refinePose(start, camera, lines, {}, options, axis);
    EXPECT_TRUE(found.converged);
    EXPECT_TRUE(found.well_posed);

    // The axis is found as a line in the camera frame.
    const Vector3d there = found.camera_from_object * axis.point, truly = truth * axis.point;
    EXPECT_LT((there - truly).norm(), 0.004);
    EXPECT_LT((found.camera_from_object.rotation * d - truth.rotation * d).norm(), 0.03);
    // Held: no more turn about the axis than second order in the other motion.
    const Vector3d turned = logSO3(start.rotation.transpose() * found.camera_from_object.rotation);
    EXPECT_LT(std::abs(turned.dot(d)), 2e-3);

    // The motion that turns the object about its axis has the variance of an unknown angle.
    const Vector3d spin = found.camera_from_object.rotation * d;
    Vector6d motion;
    motion << Vector3d(found.camera_from_object.rotation * axis.point).cross(spin), spin;
    EXPECT_NEAR(spin.dot(found.covariance.bottomRightCorner<3, 3>() * spin), M_PI * M_PI / 3, 1e-3);
    const Rigid3 spun = perturbed(found.camera_from_object, 1e-6 * motion);
    EXPECT_LT((spun * axis.point - found.camera_from_object * axis.point).norm(), 1e-12);
    EXPECT_LT(motion.normalized().dot((found.covariance - M_PI * M_PI / 3 * motion * motion.transpose()) *
                                      motion.normalized()),
              1e-3);
  }
}

TEST(Refine, OpenDirectionsAreSaid) {
  Random random(28);
  const Camera camera = unevenCamera();
  const Rigid3 truth{Matrix3d::Identity(), Vector3d(0, 0, 0.6)};
  std::vector<LineMatch> lines;
  for (int i = 0; i < 20; ++i) {  // one edge only
    LineMatch m;
    m.p_in_object = {0.01 * (i - 10), 0.02, 0};
    m.uv = camera.project(truth * m.p_in_object);
    m.normal = {0, 1};
    lines.push_back(m);
  }

  const RefinedPose found = refinePose(truth, camera, lines, {});
  EXPECT_FALSE(found.well_posed);
  EXPECT_TRUE(found.camera_from_object.isFinite());
  EXPECT_TRUE(found.covariance.allFinite());
  EXPECT_GT(found.covariance(0, 0), 0.5);  // along the edge
  const auto two = randomPoints(truth, camera, 2, 0, random);
  EXPECT_FALSE(refinePose(truth, camera, {}, two).well_posed);
}

TEST(Refine, BadNumbersNeverComeOut) {
  Random random(29);
  const Camera camera = unevenCamera();
  const Rigid3 truth = randomPose(random);
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  const auto lines = boxEdges(truth, camera, 3, 0.3, random);
  const auto points = randomPoints(truth, camera, 5, 0.3, random);

  const auto expectRefused = [&](const Rigid3& start, const Camera& c, const std::vector<LineMatch>& l,
                                 const std::vector<PointMatch>& p, const FreeAxis& axis = {}) {
    const RefinedPose found = refinePose(start, c, l, p, {}, axis);
    EXPECT_FALSE(found.converged);
    EXPECT_FALSE(found.well_posed);
    EXPECT_TRUE(found.camera_from_object.isFinite());
    EXPECT_TRUE(found.covariance.allFinite());
    EXPECT_TRUE(std::isfinite(found.rms) && std::isfinite(found.inliers));
  };

  for (const double value : bad) {
    Rigid3 start = truth;
    start.translation.x() = value;
    expectRefused(start, camera, lines, points);
    Camera c = camera;
    c.fx = value;
    expectRefused(truth, c, lines, points);
    auto l = lines;
    l[4].uv.y() = value;
    expectRefused(truth, camera, l, points);
    l = lines;
    l[2].normal.x() = value;
    expectRefused(truth, camera, l, points);
    auto p = points;
    p[1].p_in_object.z() = value;
    expectRefused(truth, camera, lines, p);
    p = points;
    p[1].sigma = value;
    expectRefused(truth, camera, lines, p);
    FreeAxis axis;
    axis.present = true;
    axis.direction.x() = value;
    expectRefused(truth, camera, lines, points, axis);
  }

  auto l = lines;
  l[0].sigma = 0;
  expectRefused(truth, camera, l, points);
  expectRefused(truth, camera, {}, {});
  expectRefused({Matrix3d::Identity(), Vector3d(0, 0, -1)}, camera, lines, points);  // all behind the camera
}

TEST(Refine, TurningTheImageTurnsThePose) {
  Random random(30);
  Camera camera = unevenCamera();
  camera.fy = camera.fx;
  const Vector2d middle(camera.cx, camera.cy);
  for (int draw = 0; draw < 50; ++draw) {
    const Rigid3 truth = randomPose(random), start = perturbed(truth, randomStep(random, 0.004, 0.02));
    const double angle = uniform(random, 0, 2 * M_PI);
    const Rigid3 turn{expSO3({0, 0, angle}), Vector3d::Zero()};
    const Eigen::Rotation2Dd turn2(angle);
    const auto lines = boxEdges(truth, camera, 3, 0.3, random);
    const auto points = randomPoints(truth, camera, 6, 0.3, random);

    auto turned_lines = lines;
    auto turned_points = points;
    for (LineMatch& m : turned_lines) {
      m.uv = middle + turn2 * (m.uv - middle);
      m.normal = turn2 * m.normal;
    }
    for (PointMatch& m : turned_points) m.uv = middle + turn2 * (m.uv - middle);

    RefineOptions options;
    options.max_iterations = 50;
    const RefinedPose one = refinePose(start, camera, lines, points, options);
    const RefinedPose two = refinePose(turn * start, camera, turned_lines, turned_points, options);
    EXPECT_THAT(two.camera_from_object, PoseNear(turn * one.camera_from_object, 0.001, 6e-05));
    Matrix6d both = Matrix6d::Zero();
    both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = turn.rotation;
    EXPECT_LT((both * one.covariance * both.transpose() - two.covariance).norm(),
              1e-3 * two.covariance.norm());
  }
}

TEST(Refine, IdenticalAndCollinearPointsFixNoPose) {
  Random random(31);
  const Camera camera = unevenCamera();

  for (int draw = 0; draw < 50; ++draw) {
    const Rigid3 truth = randomPose(random);
    for (const bool identical : {true, false}) {
      std::vector<PointMatch> points;
      for (int i = 0; i < 8; ++i) {
        PointMatch m;
        m.p_in_object = Vector3d(0.01, 0.02, 0.03) + (identical ? 0.0 : 0.01 * i) * Vector3d(1, 2, -1);
        m.uv = camera.project(truth * m.p_in_object);
        points.push_back(m);
      }
      const RefinedPose found =
          refinePose(perturbed(truth, randomStep(random, 0.002, 0.01)), camera, {}, points);
      EXPECT_FALSE(found.well_posed);
      EXPECT_TRUE(found.camera_from_object.isFinite());
      EXPECT_TRUE(found.covariance.allFinite());
      const Eigen::Vector3d turns = found.covariance.diagonal().tail(3);
      EXPECT_GT(turns.sum(), 1);  // one is open
    }
  }
}

TEST(Refine, OptionsAreChecked) {
  RefineOptions options;
  options.check();
  const auto expectRefused = [](RefineOptions o, const char* field) {
    EXPECT_THAT(refusal([&] { o.check(); }), testing::HasSubstr(field));
  };
  options.max_iterations = 0;
  expectRefused(options, "max_iterations");
  options = {};
  options.robust_scale = -1;
  expectRefused(options, "robust_scale");
  options = {};
  options.min_step = std::numeric_limits<double>::quiet_NaN();
  expectRefused(options, "min_step");
  int fields = 0;
  options.visit([&](const char*, auto&) { ++fields; });
  EXPECT_EQ(fields, 3);
}

}  // namespace
}  // namespace monocular_eye_hand
