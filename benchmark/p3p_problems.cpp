#include "p3p_problems.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace monocular_eye_hand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180;

P3PProblem seen(const Matrix3d& points, const Rigid3& camera_from_object) {
  P3PProblem p{points, {}, camera_from_object};
  for (int i = 0; i < 3; ++i) p.bearings.col(i) = (camera_from_object * Vector3d(points.col(i))).normalized();
  return p;
}

double longestSide(const Matrix3d& p) {
  return std::max({(p.col(0) - p.col(1)).norm(), (p.col(1) - p.col(2)).norm(), (p.col(2) - p.col(0)).norm()});
}

/// Altitude on the longest side, over that side.
double flatness(const Matrix3d& p) {
  const double side = longestSide(p);
  return (p.col(1) - p.col(0)).cross(p.col(2) - p.col(0)).norm() / (side * side);
}

Vector3d inView(Random& random, double half_angle) {
  const double t = std::tan(half_angle), x = uniform(random, -t, t), y = uniform(random, -t, t);
  return {x, y, 1};
}

P3PProblem general(Random& random, double) {
  for (;;) {
    Matrix3d in_camera, bearings;
    for (int i = 0; i < 3; ++i) {
      bearings.col(i) = inView(random, 35 * kDegree).normalized();
      in_camera.col(i) = uniform(random, 0.5, 10) * bearings.col(i);
    }
    double apart = 1;
    for (int i = 0; i < 3; ++i)
      apart = std::min(apart, bearings.col(i).cross(bearings.col((i + 1) % 3)).norm());
    if (flatness(in_camera) < 0.05 || apart < 0.02) continue;
    Rigid3 truth;
    truth.rotation = randomRotation(random);
    for (int i = 0; i < 3; ++i) truth.translation[i] = normal(random);
    return {truth.rotation.transpose() * (in_camera.colwise() - truth.translation), bearings, truth};
  }
}

P3PProblem farAway(Random& random, double distance) {
  Matrix3d points;
  do {
    for (int i = 0; i < 9; ++i) points(i) = uniform(random, -0.5, 0.5);
  } while (flatness(points) < 0.1);
  const Matrix3d rotation = randomRotation(random);
  return seen(points,
              {rotation, inView(random, 25 * kDegree).normalized() * (distance * longestSide(points))});
}

P3PProblem boxCorner(Random& random, double) {
  Matrix3d points = Matrix3d::Zero();
  const int axis = int(random() % 3);
  points(axis, 1) = uniform(random, 0.3, 1);
  points((axis + 1) % 3, 2) = uniform(random, 0.3, 1);
  const Matrix3d rotation = randomRotation(random);
  const double x = uniform(random, -0.4, 0.4), y = uniform(random, -0.4, 0.4);
  return seen(points, {rotation, Vector3d(x, y, 1).normalized() * uniform(random, 4, 30)});
}

P3PProblem symmetric(Random& random, double) {
  const bool equilateral = random() % 2 == 0;
  const double height = equilateral ? std::sqrt(0.75) : uniform(random, 0.4, 1.5);
  Matrix3d points;
  points << -0.5, 0.5, 0, 0, 0, height, 0, 0, 0;
  const double distance = uniform(random, 3, 30);
  const double below = equilateral ? height / 3 : uniform(random, 0, height);
  const double tilt = random() % 2 == 0 ? 0 : uniform(random, -0.8, 0.8);
  return seen(points, {expSO3({tilt, 0, 0}), Vector3d(0, -below, distance)});
}

P3PProblem nearlyCollinear(Random& random, double altitude) {
  Matrix3d points;
  points << -0.5, 0.5, uniform(random, -0.3, 0.3), 0, 0, altitude, 0, 0, 0;
  points = (randomRotation(random) * points).eval();
  const Matrix3d rotation = randomRotation(random);
  const double x = uniform(random, -1, 1), y = uniform(random, -1, 1);
  return seen(points, {rotation, Vector3d(x, y, uniform(random, 2, 6))});
}

P3PProblem nearDangerCylinder(Random& random, double distance) {
  Matrix3d points;
  do {
    for (int i = 0; i < 3; ++i) {
      const double angle = uniform(random, 0, 2 * M_PI);
      points.col(i) = Vector3d(std::cos(angle), std::sin(angle), 0);
    }
  } while (flatness(points) < 0.15);
  const double angle = uniform(random, 0, 2 * M_PI), r = 1 + distance;
  const Vector3d lens(r * std::cos(angle), r * std::sin(angle), uniform(random, 1.5, 6));
  const double aim_x = uniform(random, -0.2, 0.2), aim_y = uniform(random, -0.2, 0.2);
  Matrix3d rotation;
  rotation.row(2) = (Vector3d(aim_x, aim_y, 0) - lens).normalized();
  rotation.row(0) = rotation.row(2).transpose().unitOrthogonal();
  rotation.row(1) = rotation.row(2).cross(rotation.row(0));
  const Matrix3d turn = randomRotation(random);
  return seen(turn * points, {rotation * turn.transpose(), -rotation * lens});
}

}  // namespace

const std::vector<P3PSet>& p3pSets() {
  static const std::vector<P3PSet> sets = {
      {"general", 1000000, general, 0},
      {"far10", 200000, farAway, 10},
      {"far30", 200000, farAway, 30},
      {"far100", 200000, farAway, 100},
      {"far300", 200000, farAway, 300},
      {"box_corner", 200000, boxCorner, 0},
      {"symmetric", 100000, symmetric, 0},
      {"symmetric+1e-9", 100000, symmetric, 0, 1e-9},
      {"symmetric+1e-6", 100000, symmetric, 0, 1e-6},
      {"collinear1e-2", 100000, nearlyCollinear, 1e-2},
      {"collinear1e-4", 100000, nearlyCollinear, 1e-4},
      {"danger1e-2", 100000, nearDangerCylinder, 1e-2},
      {"danger1e-4", 100000, nearDangerCylinder, 1e-4},
      {"danger1e-6", 100000, nearDangerCylinder, 1e-6},
      {"symmetric+5e-4", 100000, symmetric, 0, 5e-4},
      {"box_corner+5e-4", 100000, boxCorner, 0, 5e-4},
      {"far30+5e-4", 100000, farAway, 30, 5e-4},
  };
  return sets;
}

const P3PSet& p3pSet(const std::string& name) {
  for (const P3PSet& set : p3pSets())
    if (set.name == name) return set;
  throw std::invalid_argument("no set of problems " + name);
}

std::vector<P3PProblem> drawProblems(const P3PSet& set, int count) {
  Random random(12345);
  std::vector<P3PProblem> problems;
  problems.reserve(size_t(count));
  for (int i = 0; i < count; ++i) {
    P3PProblem p = set.draw(random, set.parameter);
    if (set.noise > 0) {
      for (int k = 0; k < 9; ++k) p.bearings(k) += set.noise * normal(random);
      p.bearings.colwise().normalize();
    }
    problems.push_back(p);
  }
  return problems;
}

double poseError(const Rigid3& pose, const Rigid3& truth) {
  return std::max((pose.rotation - truth.rotation).norm(),
                  (pose.translation - truth.translation).norm() / truth.translation.norm());
}

}  // namespace monocular_eye_hand
