#include "monocular_eye_hand/pose/p3p.h"
#include "relative_error.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace monocular_eye_hand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Problem {
  Matrix3d points, bearings;
  Rigid3 truth;  // camera_from_object
};

Problem seen(const Matrix3d& points, const Rigid3& camera_from_object) {
  Problem p{points, {}, camera_from_object};
  for (int i = 0; i < 3; ++i) p.bearings.col(i) = (camera_from_object * Vector3d(points.col(i))).normalized();
  return p;
}

double bestError(const Problem& problem) {
  const PoseSolutions s = solveP3P(problem.bearings, problem.points);
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < s.count; ++i)
    best = std::min(best, relativeError(s.camera_from_object[i], problem.truth));
  return best;
}

/// Every pose returned is a rotation, puts the points on the bearings in front of the lens, and comes once.
void expectSound(const Problem& problem, double tolerance = 1e-7) {
  const PoseSolutions s = solveP3P(problem.bearings, problem.points);
  for (int i = 0; i < s.count; ++i) {
    const Rigid3& pose = s.camera_from_object[i];
    EXPECT_LT((pose.rotation * pose.rotation.transpose() - Matrix3d::Identity()).norm(), 1e-13);
    EXPECT_GT(pose.rotation.determinant(), 0);
    for (int k = 0; k < 3; ++k) {
      const Vector3d p = pose * Vector3d(problem.points.col(k));
      EXPECT_LT((p.normalized() - problem.bearings.col(k)).norm(), tolerance);
    }
    for (int k = 0; k < i; ++k) EXPECT_GT(relativeError(pose, s.camera_from_object[k]), 1e-8);
  }
}

Matrix3d randomTriangle(Random& random, double min_altitude) {
  for (;;) {
    Matrix3d p;
    for (int i = 0; i < 9; ++i) p(i) = uniform(random, -0.5, 0.5);
    const double longest =
        std::max({(p.col(0) - p.col(1)).norm(), (p.col(0) - p.col(2)).norm(), (p.col(1) - p.col(2)).norm()});
    if ((p.col(1) - p.col(0)).cross(p.col(2) - p.col(0)).norm() > min_altitude * longest * longest) return p;
  }
}

Vector3d inView(Random& random, double distance) {
  const double x = uniform(random, -0.45, 0.45), y = uniform(random, -0.45, 0.45);
  return Vector3d(x, y, 1).normalized() * distance;
}

TEST(P3P, KnownSolutionsAllFoundNoOther) {
  std::ifstream file(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/test/pose/data/p3p.txt");
  ASSERT_TRUE(file);
  std::string line;
  std::stringstream numbers;
  while (std::getline(file, line))
    if (line[0] != '#') numbers << line << '\n';

  int problems = 0, with_count[5] = {};
  Matrix3d points, bearings;
  while (numbers >> points(0)) {
    for (int i = 1; i < 9; ++i) numbers >> points(i);
    for (int i = 0; i < 9; ++i) numbers >> bearings(i);
    int count = 0;
    numbers >> count;
    ASSERT_TRUE(numbers && count >= 1 && count <= 4);
    ++problems;
    ++with_count[count];

    const PoseSolutions poses = solveP3P(bearings, points * 1e-3);
    const TetrahedronLegs tetrahedron =
        solveTetrahedron(bearings, 1e-3 * Vector3d((points.col(1) - points.col(2)).norm(),
                                                   (points.col(0) - points.col(2)).norm(),
                                                   (points.col(0) - points.col(1)).norm()));
    EXPECT_EQ(poses.count, count) << "problem " << problems;
    EXPECT_EQ(tetrahedron.count, count) << "problem " << problems;

    for (int s = 0; s < count; ++s) {
      Vector3d legs, t;
      Matrix3d r;
      for (int i = 0; i < 3; ++i) numbers >> legs[i];
      for (int i = 0; i < 9; ++i) numbers >> r(i / 3, i % 3);
      for (int i = 0; i < 3; ++i) numbers >> t[i];
      double pose_error = 1, legs_error = 1;
      for (int i = 0; i < poses.count; ++i)
        pose_error = std::min(pose_error, relativeError(poses.camera_from_object[i], {r, 1e-3 * t}));
      for (int i = 0; i < tetrahedron.count; ++i)
        legs_error = std::min(legs_error, (tetrahedron.legs[i] - 1e-3 * legs).norm() / (1e-3 * legs.norm()));
      EXPECT_LT(pose_error, 1e-7) << "problem " << problems;  // the file's own digits
      EXPECT_LT(legs_error, 1e-7) << "problem " << problems;
    }
  }

  EXPECT_EQ(problems, 40);
  for (int i = 1; i <= 4; ++i) EXPECT_GT(with_count[i], 0);
}

TEST(P3P, RandomPosesNearAndFar) {
  Random random(1);
  for (const double distance : {1.5, 10.0, 30.0, 100.0, 300.0}) {
    for (int i = 0; i < 4000; ++i) {
      const Problem p = seen(randomTriangle(random, 0.1), {randomRotation(random), inView(random, distance)});
      ASSERT_LT(bestError(p), 1e-8) << "distance " << distance << ", draw " << i;
      if (i % 10 == 0) expectSound(p);
    }
  }
}

TEST(P3P, LegsSatisfyTheCosineLaws) {
  Random random(2);
  int solutions = 0;
  for (int i = 0; i < 2000; ++i) {
    const Problem p =
        seen(randomTriangle(random, 0.1), {randomRotation(random), inView(random, uniform(random, 1, 20))});
    const Vector3d sides((p.points.col(1) - p.points.col(2)).norm(),
                         (p.points.col(0) - p.points.col(2)).norm(),
                         (p.points.col(0) - p.points.col(1)).norm());
    const TetrahedronLegs t = solveTetrahedron(p.bearings, sides);
    EXPECT_GE(t.count, 1);
    for (int s = 0; s < t.count; ++s, ++solutions)
      for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const double side = (t.legs[s][a] * p.bearings.col(a) - t.legs[s][b] * p.bearings.col(b)).norm();
        EXPECT_GT(t.legs[s][k], 0);
        EXPECT_NEAR(side, sides[k], 1e-12 * t.legs[s].sum());
      }
  }

  EXPECT_GT(solutions, 3000);  // 1.5 and more per problem: other roots than the true one are found too
}

TEST(P3P, SymmetricViewsLoseNoSolution) {
  // Equilateral and isosceles triangles seen along their mirror plane: coefficients vanish exactly.
  Random random(3);
  for (int i = 0; i < 4000; ++i) {
    const bool equilateral = i % 2 == 0;
    const double h = equilateral ? std::sqrt(0.75) : uniform(random, 0.4, 1.5),
                 distance = uniform(random, 3, 30);
    Matrix3d points;
    points << -0.5, 0.5, 0, 0, 0, h, 0, 0, 0;
    const double tilt = i % 4 < 2 ? 0 : uniform(random, -0.8, 0.8);
    const Rigid3 pose{expSO3({tilt, 0, 0}),
                      Vector3d(0, equilateral ? -h / 3 : -uniform(random, 0, h), distance)};
    const Problem p = seen(points, pose);
    ASSERT_LT(bestError(p), 1e-6) << "draw " << i;
    expectSound(p);
  }
}

TEST(P3P, EquilateralAlongItsAxisHasFourSolutions) {
  // Legs (s, s, s) and the three with one leg shortened to s (2 cos - 1), which is positive when cos > 1/2.
  Matrix3d points;
  points << -0.5, 0.5, 0, 0, 0, std::sqrt(0.75), 0, 0, 0;
  const Problem p = seen(points, {Matrix3d::Identity(), Vector3d(0, -std::sqrt(0.75) / 3, 4)});
  const TetrahedronLegs t = solveTetrahedron(p.bearings, Vector3d::Ones());
  ASSERT_EQ(t.count, 4);
  const double cosine = p.bearings.col(0).dot(p.bearings.col(1)), s = 1 / std::sqrt(2 - 2 * cosine);
  int equal = 0, shortened = 0;
  for (int i = 0; i < 4; ++i) {
    Vector3d legs = t.legs[i];
    std::sort(legs.data(), legs.data() + 3);
    EXPECT_NEAR(legs[2], s, 1e-12);
    EXPECT_NEAR(legs[1], s, 1e-12);
    if (std::abs(legs[0] - s) < 1e-9) ++equal;
    if (std::abs(legs[0] - s * (2 * cosine - 1)) < 1e-9) ++shortened;
  }

  EXPECT_EQ(equal, 1);
  EXPECT_EQ(shortened, 3);
}

TEST(P3P, NearCollinearObjectPoints) {
  Random random(4);
  for (const double altitude : {1e-2, 1e-4}) {
    for (int i = 0; i < 4000; ++i) {
      Matrix3d points;
      points << -0.5, 0.5, uniform(random, -0.3, 0.3), 0, 0, altitude, 0, 0, 0;
      points = randomRotation(random) * points;
      const Problem p = seen(points, {randomRotation(random), inView(random, uniform(random, 2, 6))});
      ASSERT_LT(bestError(p), 1e-6) << "altitude " << altitude << ", draw " << i;
    }
  }
}

TEST(P3P, NearTheDangerCylinder) {
  // The lens on the cylinder over the points' circle: two solutions fall together.
  Random random(5);
  const double distances[] = {1e-2, 1e-4, 0};
  const double tolerances[] = {1e-9, 1e-7, 1e-4};  // a double root keeps half of the digits

  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 2000; ++i) {
      Matrix3d points;
      do {
        for (int c = 0; c < 3; ++c) {
          const double angle = uniform(random, 0, 2 * M_PI);
          points.col(c) = Vector3d(std::cos(angle), std::sin(angle), 0);
        }
      } while ((points.col(1) - points.col(0)).cross(points.col(2) - points.col(0)).norm() < 0.5);
      const double angle = uniform(random, 0, 2 * M_PI), r = 1 + distances[k];
      const Vector3d lens(r * std::cos(angle), r * std::sin(angle), uniform(random, 1.5, 6));
      const Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(-lens, Vector3d::UnitZ()).toRotationMatrix();
      const Problem p = seen(points, {turn, -turn * lens});
      ASSERT_LT(bestError(p), tolerances[k]) << "distance " << distances[k] << ", draw " << i;
      expectSound(p, 1e-6);
    }
  }
}

TEST(P3P, BearingsInOnePlane) {
  // Collinear image points, figure 6 of Wong et al.: the lens lies in the plane of the object's points.
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    Matrix3d points = randomTriangle(random, 0.2);
    const Vector3d normal = (points.col(1) - points.col(0)).cross(points.col(2) - points.col(0)).normalized();
    const Matrix3d turn = randomRotation(random);
    Vector3d t = turn * randomDirection(random) * uniform(random, 2, 10);
    const Vector3d n = turn * normal;
    t -= n * n.dot(t + turn * points.col(0));  // the plane through the lens
    const Problem p = seen(points, {turn, t});
    ASSERT_LT(std::abs(p.bearings.determinant()), 1e-13);
    ASSERT_LT(bestError(p), 1e-5) << "draw " << i;
    Matrix3d in_camera;
    for (int k = 0; k < 3; ++k) in_camera.col(k) = p.truth * Vector3d(points.col(k));
    const Rigid3 object_from_camera = objectFromCamera(points, in_camera);
    EXPECT_LT(relativeError(object_from_camera.inverse(), p.truth), 1e-12);
  }
}

TEST(P3P, ObjectFromCameraInvertsThePose) {
  Random random(7);
  for (const double distance : {0.8, 3.0, 30.0, 300.0})
    for (int i = 0; i < 1000; ++i) {
      const Matrix3d points = randomTriangle(random, 0.1);
      const Rigid3 truth{randomRotation(random), inView(random, distance)};
      Matrix3d in_camera;
      for (int k = 0; k < 3; ++k) in_camera.col(k) = truth * Vector3d(points.col(k));
      const Rigid3 object_from_camera = objectFromCamera(points, in_camera);
      EXPECT_LT(relativeError(object_from_camera.inverse(), truth), 1e-9)
          << distance;  // |T| / volume x rounding
      EXPECT_NEAR(object_from_camera.rotation.determinant(), 1, 1e-12);
      for (int k = 0; k < 3; ++k)  // eq. 6
        EXPECT_LT((object_from_camera * Vector3d(in_camera.col(k)) - points.col(k)).norm(), 1e-9 * distance);
    }
}

TEST(P3P, FourthPointChoosesThePose) {
  Random random(8);
  int several = 0;
  for (int i = 0; i < 1000; ++i) {
    const Problem p =
        seen(randomTriangle(random, 0.2), {randomRotation(random), inView(random, uniform(random, 1.5, 10))});
    const Vector3d fourth = 0.5 * randomDirection(random);
    const PoseSolutions poses = solveP3P(p.bearings, p.points);
    double angle = 1;
    const int chosen = chooseByFourthPoint(poses, fourth, p.truth * fourth, &angle);
    ASSERT_GE(chosen, 0);
    several += poses.count > 1;
    EXPECT_LT(angle, 1e-9);
    EXPECT_LT(relativeError(poses.camera_from_object[chosen], p.truth), 1e-6);
  }
  EXPECT_GT(several, 500);
  EXPECT_EQ(chooseByFourthPoint(PoseSolutions(), Vector3d::UnitX(), Vector3d::UnitZ()), -1);
}

TEST(P3P, TurningTheCameraTurnsThePose) {
  Random random(9);
  for (int i = 0; i < 500; ++i) {
    const Problem p = seen(randomTriangle(random, 0.1), {randomRotation(random), inView(random, 3)});
    const Rigid3 turn{randomRotation(random), Vector3d::Zero()};
    const PoseSolutions a = solveP3P(p.bearings, p.points),
                        b = solveP3P(turn.rotation * p.bearings, p.points);
    ASSERT_EQ(a.count, b.count);
    for (int k = 0; k < a.count; ++k) {
      double best = 1;
      for (int m = 0; m < b.count; ++m)
        best = std::min(best, relativeError(b.camera_from_object[m], turn * a.camera_from_object[k]));
      EXPECT_LT(best, 1e-7);
    }
  }
}

/// Every pose of `a`, times `right`, is one of `b`.
void expectSamePoses(const PoseSolutions& a, const PoseSolutions& b, const Rigid3& right,
                     double tolerance = 1e-7) {
  ASSERT_EQ(a.count, b.count);
  for (int k = 0; k < a.count; ++k) {
    double best = 1;
    for (int m = 0; m < b.count; ++m)
      best = std::min(best, relativeError(b.camera_from_object[m], a.camera_from_object[k] * right));
    EXPECT_LT(best, tolerance);
  }
}

TEST(P3P, MovingTheObjectsFrameMovesThePose) {
  Random random(11);
  for (int i = 0; i < 500; ++i) {
    const Problem p = seen(randomTriangle(random, 0.1), {randomRotation(random), inView(random, 3)});
    const Rigid3 move{randomRotation(random), randomDirection(random)};
    Matrix3d moved;
    for (int k = 0; k < 3; ++k) moved.col(k) = move * Vector3d(p.points.col(k));
    expectSamePoses(solveP3P(p.bearings, p.points), solveP3P(p.bearings, moved), move.inverse());
  }
}

TEST(P3P, OrderOfThePointsDoesNotMatter) {
  Random random(12);
  const int orders[5][3] = {{0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int i = 0; i < 500; ++i) {
    const Problem p = seen(randomTriangle(random, 0.1), {randomRotation(random), inView(random, 3)});
    const PoseSolutions one = solveP3P(p.bearings, p.points);
    for (const auto& order : orders) {
      Matrix3d points, bearings;
      for (int k = 0; k < 3; ++k) {
        points.col(k) = p.points.col(order[k]);
        bearings.col(k) = p.bearings.col(order[k]);
      }
      expectSamePoses(one, solveP3P(bearings, points), {});
    }
  }
}

TEST(P3P, UnitOfLengthDoesNotMatter) {
  Random random(13);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6})
    for (int i = 0; i < 200; ++i) {
      const Problem p = seen(randomTriangle(random, 0.1), {randomRotation(random), inView(random, 3)});
      PoseSolutions one = solveP3P(p.bearings, p.points);
      for (int k = 0; k < one.count; ++k) one.camera_from_object[k].translation *= scale;
      expectSamePoses(one, solveP3P(p.bearings, scale * p.points), {});
    }
}

TEST(P3P, IdenticalPointsAndBearings) {
  Random random(14);
  for (int i = 0; i < 200; ++i) {
    const Problem p = seen(randomTriangle(random, 0.2), {randomRotation(random), inView(random, 3)});
    for (int k = 0; k < 3; ++k) {
      Matrix3d points = p.points;
      points.col(k) = points.col((k + 1) % 3);
      EXPECT_EQ(solveP3P(p.bearings, points).count, 0);
      // Two points on one ray: poses may exist, and are then sound.
      Problem on_one_ray = p;
      on_one_ray.bearings.col(k) = on_one_ray.bearings.col((k + 1) % 3);
      expectSound(on_one_ray);
    }
  }
}

TEST(P3P, TwoPointsOnOneRayAreFound) {
  Random random(15);
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    Matrix3d in_camera;
    in_camera.col(0) = inView(random, uniform(random, 2, 4));
    in_camera.col(1) = in_camera.col(0) * uniform(random, 1.2, 2);
    in_camera.col(2) = inView(random, uniform(random, 2, 4));
    const Rigid3 truth{randomRotation(random), randomDirection(random)};
    Problem p{truth.rotation.transpose() * (in_camera.colwise() - truth.translation), in_camera, truth};
    p.bearings.colwise().normalize();
    p.bearings.col(1) = p.bearings.col(0);
    found += bestError(p) < 1e-6;
    expectSound(p);
  }
  EXPECT_GE(found, 495);
}

TEST(P3P, NoSolutionIsAResult) {
  Random random(10);
  const Problem p = seen(randomTriangle(random, 0.2), {randomRotation(random), inView(random, 3)});
  Matrix3d collinear = p.points;
  collinear.col(2) = 0.3 * collinear.col(0) + 0.7 * collinear.col(1);
  EXPECT_EQ(solveP3P(p.bearings, collinear).count, 0);
  EXPECT_EQ(solveP3P(p.bearings, Matrix3d::Zero()).count, 0);
  Matrix3d same;
  same.colwise() = Vector3d(p.bearings.col(0));
  EXPECT_EQ(solveP3P(same, p.points).count, 0);
  EXPECT_EQ(solveTetrahedron(p.bearings, {1, 1, 3}).count, 0);  // no triangle
  EXPECT_EQ(solveTetrahedron(p.bearings, {1, 1, 0}).count, 0);

  // A triangle whose side 12 would have to be seen wider than the other two views allow.
  Matrix3d wide;
  wide << -0.9, 0.9, 0, 0, 0, 0.05, 0.2, 0.2, 1;
  wide.colwise().normalize();
  const PoseSolutions none = solveP3P(wide, (Matrix3d() << 0, 0.05, 0.5, 0, 0, 0.7, 0, 0, 0).finished());
  for (int i = 0; i < none.count; ++i) EXPECT_TRUE(none.camera_from_object[i].isFinite());

  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  for (const double value : bad)
    for (int i = 0; i < 9; ++i) {
      Matrix3d bearings = p.bearings, points = p.points;
      bearings(i) = value;
      points(i) = value;
      EXPECT_EQ(solveP3P(bearings, p.points).count, 0) << value << " at " << i;
      EXPECT_EQ(solveP3P(p.bearings, points).count, 0) << value << " at " << i;
      EXPECT_EQ(solveTetrahedron(bearings, {1, 1, 1}).count, 0);
    }
}

}  // namespace
}  // namespace monocular_eye_hand
