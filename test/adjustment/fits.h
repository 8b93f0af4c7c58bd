#pragma once
#include <vector>

#include "monocular_eye_hand/adjustment/problem.h"
#include "support/random.h"

namespace monocular_eye_hand {

/// Points on the line y = a + b x, measured with noise; `group_size` in a row share an error of `shared`
/// more.
struct LineData {
  std::vector<double> x, y;
  int group_size = 1;
};

inline LineData lineData(Random& random, int count, double sigma, int group_size = 1, double shared = 0) {
  LineData data;
  data.group_size = group_size;
  double of_group = 0;
  for (int i = 0; i < count; ++i) {
    if (i % group_size == 0) of_group = shared * normal(random);
    data.x.push_back(uniform(random, -1, 1));
    data.y.push_back(2 + 3 * data.x.back() + of_group + sigma * normal(random));
  }
  return data;
}

/// One term a group; block 0 is (a, b).
inline AdjustmentProblem lineProblem(const LineData& data, double sigma, const RobustLoss& loss = {}) {
  AdjustmentProblem problem;
  const BlockId line = problem.addVector("line", Eigen::Vector2d(0, 0));
  for (size_t first = 0; first < data.x.size(); first += size_t(data.group_size)) {
    Term term;
    term.blocks = {line};
    term.residuals = data.group_size;
    term.loss = loss;
    term.group = int(first) / data.group_size;
    term.evaluate = [=](const TermValues& at, bool derivatives, TermErrors* errors) {
      for (int i = 0; i < data.group_size; ++i) {
        const double x = data.x[first + size_t(i)];
        errors->residuals[i] = (at.vector(0)[0] + at.vector(0)[1] * x - data.y[first + size_t(i)]) / sigma;
        if (derivatives) errors->jacobians[0].row(i) << 1 / sigma, x / sigma;
      }
      return true;
    };
    problem.addTerm(term);
  }
  return problem;
}

/// Cameras around points, each point seen by each camera; poses and points are unknown.
struct BundleWorld {
  std::vector<Eigen::Vector3d> points;
  std::vector<Rigid3> views;  ///< camera_from_world
};

inline BundleWorld bundleWorld(Random& random, int points, int views) {
  BundleWorld world;
  for (int i = 0; i < points; ++i)
    world.points.push_back(0.2 * randomVector(random).cwiseMax(-1).cwiseMin(1));
  for (int i = 0; i < views; ++i)
    world.views.push_back({expSO3(0.5 * randomDirection(random)), Eigen::Vector3d(0, 0, 2)});
  return world;
}

struct BundleBlocks {
  std::vector<BlockId> points, views;
};

/// Normalised image coordinates with noise; the starts are off by centimetres and degrees.
inline AdjustmentProblem bundleProblem(Random& random, const BundleWorld& world, double sigma,
                                       BundleBlocks* blocks) {
  AdjustmentProblem problem;
  for (const Eigen::Vector3d& point : world.points)
    blocks->points.push_back(problem.addVector("point", point + 0.01 * randomVector(random)));
  for (const Rigid3& view : world.views) {
    Vector6d d;
    d << 0.01 * randomVector(random), 0.01 * randomVector(random);
    blocks->views.push_back(problem.addPose("view", perturbed(view, d)));
  }

  for (size_t v = 0; v < world.views.size(); ++v)
    for (size_t p = 0; p < world.points.size(); ++p) {
      const Eigen::Vector3d seen = world.views[v] * world.points[p];
      const Eigen::Vector2d measured =
          seen.hnormalized() + sigma * Eigen::Vector2d(normal(random), normal(random));
      Term term;
      term.blocks = {blocks->views[v], blocks->points[p]};
      term.residuals = term.residuals_per_error = 2;
      term.group = int(v);
      term.evaluate = [measured, sigma](const TermValues& at, bool derivatives, TermErrors* errors) {
        const Eigen::Vector3d rotated = at.pose(0).rotation * at.vector(1);
        const Eigen::Vector3d q = rotated + at.pose(0).translation;
        if (q.z() <= 0) return false;
        errors->residuals = (q.hnormalized() - measured) / sigma;
        if (!derivatives) return true;
        Eigen::Matrix<double, 2, 3> by_q;
        by_q << 1 / q.z(), 0, -q.x() / (q.z() * q.z()), 0, 1 / q.z(), -q.y() / (q.z() * q.z());
        by_q /= sigma;
        errors->jacobians[0] << by_q, -by_q * skew(rotated);
        errors->jacobians[1] = by_q * at.pose(0).rotation;
        return true;
      };
      problem.addTerm(term);
    }
  return problem;
}

}  // namespace monocular_eye_hand
