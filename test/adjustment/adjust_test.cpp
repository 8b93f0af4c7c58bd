#include "monocular_eye_hand/adjustment/adjust.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "fits.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

Eigen::Vector2d leastSquaresLine(const LineData& data) {
  Eigen::Matrix2d h = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < data.x.size(); ++i) {
    const Eigen::Vector2d row(1, data.x[i]);
    h += row * row.transpose();
    g += row * data.y[i];
  }
  return h.ldlt().solve(g);
}

TEST(Adjust, ALinearProblemHasItsLeastSquaresSolution) {
  Random random(1);
  const LineData data = lineData(random, 50, 0.1);
  AdjustmentProblem problem = lineProblem(data, 0.1);
  const AdjustmentReport report = adjust(&problem);
  EXPECT_TRUE(report.converged());
  EXPECT_TRUE(problem.vector(0).isApprox(leastSquaresLine(data), 1e-8));
  EXPECT_EQ(report.cost, costOf(problem));
  EXPECT_LT(report.cost, report.first_cost);
}

TEST(Adjust, ARobustLossForgetsWhatIsWrongAltogether) {
  Random random(2);
  LineData data = lineData(random, 100, 0.05);
  for (size_t i = 0; i < data.y.size(); i += 5) data.y[i] += 10;
  AdjustmentProblem squares = lineProblem(data, 0.05),
                    cauchy = lineProblem(data, 0.05, RobustLoss::cauchy(2));
  adjust(&squares);
  adjust(&cauchy);
  EXPECT_GT(std::abs(squares.vector(0)[0] - 2), 1);
  EXPECT_NEAR(cauchy.vector(0)[0], 2, 0.03);
  EXPECT_NEAR(cauchy.vector(0)[1], 3, 0.05);
}

TEST(Adjust, WhatIsHeldKeepsItsValue) {
  Random random(3);
  AdjustmentProblem problem = lineProblem(lineData(random, 50, 0.1), 0.1);
  problem.hold(0, 0);
  EXPECT_TRUE(adjust(&problem).converged());
  EXPECT_EQ(problem.vector(0)[0], 0);
  EXPECT_GT(problem.vector(0)[1], 1);

  AdjustmentProblem all = problem;
  all.set(0, Eigen::VectorXd(Eigen::Vector2d(7, 8)));
  all.hold(0);
  EXPECT_TRUE(adjust(&all).converged());
  EXPECT_EQ(all.vector(0), Eigen::Vector2d(7, 8));
}

TEST(Adjust, RosenbrocksValleyIsFollowedToItsEnd) {
  AdjustmentProblem problem;
  const BlockId x = problem.addVector("x", Eigen::Vector2d(-1.2, 1));
  Term term;
  term.blocks = {x};
  term.residuals = 2;
  term.evaluate = withNumericJacobians([](const TermValues& at, Eigen::VectorXd* residuals) {
    const Eigen::VectorXd& v = at.vector(0);
    *residuals << 10 * (v[1] - v[0] * v[0]), 1 - v[0];
    return true;
  });
  problem.addTerm(term);
  EXPECT_TRUE(adjust(&problem).converged());
  EXPECT_TRUE(problem.vector(x).isApprox(Eigen::Vector2d(1, 1), 1e-4));
}

TEST(Adjust, WhereATermMakesNoSenseNothingIsChanged) {
  AdjustmentProblem problem;
  const BlockId x = problem.addVector("x", Eigen::VectorXd::Constant(1, -1));
  Term term;
  term.blocks = {x};
  term.residuals = 1;
  term.evaluate = [](const TermValues& at, bool derivatives, TermErrors* errors) {
    if (at.vector(0)[0] < 0) return false;
    errors->residuals[0] = std::log(at.vector(0)[0]);
    if (derivatives) errors->jacobians[0](0, 0) = 1 / at.vector(0)[0];
    return true;
  };
  problem.addTerm(term);
  EXPECT_EQ(adjust(&problem).end, AdjustmentEnd::kBadStart);
  EXPECT_EQ(problem.vector(x)[0], -1);

  // A step that would leave where it makes sense is shortened: from 10 Newton's lands at -13.
  problem.set(x, Eigen::VectorXd(Eigen::VectorXd::Constant(1, 10)));
  EXPECT_TRUE(adjust(&problem).converged());
  EXPECT_NEAR(problem.vector(x)[0], 1, 1e-4);
}

TEST(Adjust, EliminatedBlocksChangeTheWayNotTheResult) {
  Random random(5);
  const BundleWorld world = bundleWorld(random, 12, 4);
  BundleBlocks blocks;
  AdjustmentProblem whole = bundleProblem(random, world, 1e-3, &blocks);
  whole.hold(blocks.views[0]);
  whole.addPrior(blocks.points[0], world.points[0], 1e-8 * Eigen::Matrix3d::Identity());
  AdjustmentProblem by_points = whole, by_views = whole;
  for (const BlockId point : blocks.points) by_points.eliminate(point);
  for (const BlockId view : blocks.views) by_views.eliminate(view);

  const AdjustmentReport report = adjust(&whole);
  EXPECT_TRUE(report.converged());
  for (AdjustmentProblem* problem : {&by_points, &by_views}) {
    EXPECT_NEAR(adjust(problem).cost, report.cost, 1e-8 * report.cost);
    for (const BlockId point : blocks.points)
      EXPECT_TRUE(problem->vector(point).isApprox(whole.vector(point), 1e-5));
    for (const BlockId view : blocks.views)
      EXPECT_LT(difference(problem->pose(view), whole.pose(view)).norm(), 1e-5);
  }
}

TEST(Adjust, ExactMeasurementsGiveTheTruth) {
  Random random(6);
  const BundleWorld world = bundleWorld(random, 20, 5);
  BundleBlocks blocks;
  AdjustmentProblem problem = bundleProblem(random, world, 1e-9, &blocks);
  for (size_t p = 0; p < 3; ++p) {  // three points fix the seven directions that images leave open
    problem.set(blocks.points[p], Eigen::VectorXd(world.points[p]));
    problem.hold(blocks.points[p]);
  }
  for (const BlockId view : blocks.views) problem.eliminate(view);
  EXPECT_TRUE(adjust(&problem).converged());
  for (size_t v = 0; v < blocks.views.size(); ++v)
    EXPECT_LT(difference(problem.pose(blocks.views[v]), world.views[v]).norm(), 1e-6);
}

TEST(Adjust, OptionsOutOfRangeAreRefused) {
  AdjustmentProblem problem;
  AdjustmentOptions options;
  options.max_iterations = 0;
  EXPECT_THROW(adjust(&problem, options), BadInput);
  options = {};
  options.min_decrease = 0;
  EXPECT_THROW(adjust(&problem, options), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
