#include "monocular_eye_hand/adjustment/uncertainty.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "fits.h"
#include "monocular_eye_hand/adjustment/adjust.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

constexpr double kHalf = 1.386, kNineTenths = 4.605;  // chi squared of two degrees of freedom

/// How often the truth (2, 3) lies within an ellipse of the told covariance, of the lines through data that
/// share errors.
struct Coverage {
  double half = 0, nine_tenths = 0;
};

template <class CovarianceOf>
Coverage coverageOfLines(int group_size, double shared, CovarianceOf covariance_of) {
  constexpr int kRuns = 600;
  Random random(17);
  Coverage coverage;
  for (int run = 0; run < kRuns; ++run) {
    AdjustmentProblem problem = lineProblem(lineData(random, 25 * group_size, 0.1, group_size, shared), 0.1);
    adjust(&problem);
    const Eigen::MatrixXd covariance = covariance_of(AdjustmentUncertainty(problem));
    const Eigen::VectorXd off = problem.vector(0) - Eigen::Vector2d(2, 3);
    const double squared = off.dot(covariance.llt().solve(off));
    coverage.half += (squared < kHalf) / double(kRuns);
    coverage.nine_tenths += (squared < kNineTenths) / double(kRuns);
  }
  return coverage;
}

TEST(AdjustmentUncertainty, TheTruthIsInsideTheToldEllipseAsOftenAsTold) {
  const Coverage told =
      coverageOfLines(4, 0, [](const AdjustmentUncertainty& u) { return u.covariance({0}).value(); });
  EXPECT_NEAR(told.half, 0.5, 0.06);
  EXPECT_NEAR(told.nine_tenths, 0.9, 0.04);
}

TEST(AdjustmentUncertainty, TheSandwichKnowsOfErrorsThatGroupsShare) {
  const Coverage by_sigmas =
      coverageOfLines(20, 0.2, [](const AdjustmentUncertainty& u) { return u.covariance({0}).value(); });
  EXPECT_LT(by_sigmas.half, 0.25);
  const Coverage by_groups =
      coverageOfLines(20, 0.2, [](const AdjustmentUncertainty& u) { return u.sandwich({0}).value(); });
  EXPECT_NEAR(by_groups.half, 0.5, 0.07);
  EXPECT_NEAR(by_groups.nine_tenths, 0.9, 0.05);
}

TEST(AdjustmentUncertainty, TheChangeWithoutAGroupIsThatOfTheProblemWithoutIt) {
  Random random(4);
  LineData data = lineData(random, 30, 0.1, 3);
  AdjustmentProblem all = lineProblem(data, 0.1);
  adjust(&all);
  const AdjustmentUncertainty uncertainty(all);
  EXPECT_EQ(uncertainty.groups().size(), 10u);

  data.x.erase(data.x.begin() + 3, data.x.begin() + 6);
  data.y.erase(data.y.begin() + 3, data.y.begin() + 6);
  AdjustmentProblem without = lineProblem(data, 0.1);
  adjust(&without);
  EXPECT_TRUE(uncertainty.changeWithout(1, {0})->isApprox(without.vector(0) - all.vector(0), 1e-5));
}

class BundleUncertainty : public testing::Test {
 protected:
  BundleUncertainty() {
    Random random(8);
    const BundleWorld world = bundleWorld(random, 10, 4);
    problem_ = bundleProblem(random, world, 1e-3, &blocks_);
    for (size_t p = 0; p < 3; ++p)
      problem_.addPrior(blocks_.points[p], world.points[p], 1e-8 * Eigen::Matrix3d::Identity());
    adjust(&problem_);
  }
  BundleBlocks blocks_;
  AdjustmentProblem problem_;
};

TEST_F(BundleUncertainty, EliminatedBlocksHaveTheSameCovarianceAmongThemAndWithTheOthers) {
  const std::vector<BlockId> asked = {blocks_.views[2], blocks_.points[5], blocks_.views[0],
                                      blocks_.points[1]};
  const Eigen::MatrixXd whole = AdjustmentUncertainty(problem_).covariance(asked).value();
  for (const BlockId view : blocks_.views) problem_.eliminate(view);
  const AdjustmentUncertainty uncertainty(problem_);
  EXPECT_TRUE(uncertainty.covariance(asked)->isApprox(whole, 1e-6));
  EXPECT_THAT(refusal([&] { uncertainty.information({blocks_.views[0]}); }), HasSubstr("view is eliminated"));
}

TEST_F(BundleUncertainty, InformationIsTheInverseOfTheCovariance) {
  for (const BlockId point : blocks_.points) problem_.eliminate(point);
  const AdjustmentUncertainty uncertainty(problem_);
  const std::vector<BlockId> asked = {blocks_.views[1], blocks_.views[3]};
  const Eigen::MatrixXd product = uncertainty.information(asked) * *uncertainty.covariance(asked);
  EXPECT_TRUE(product.isIdentity(1e-5)) << product;
}

TEST_F(BundleUncertainty, AViewsOwnBlockLeavesWithTheView) {
  const int gone = 2;
  for (const BlockId view : blocks_.views) problem_.eliminate(view);
  problem_.addPrior(blocks_.views[size_t(gone)], problem_.pose(blocks_.views[size_t(gone)]),
                    1e-6 * Matrix6d::Identity());
  adjust(&problem_);
  const AdjustmentUncertainty uncertainty(problem_);

  AdjustmentProblem without;
  for (const BlockId point : blocks_.points) without.addVector("point", problem_.vector(point));
  for (const BlockId view : blocks_.views) without.addPose("view", problem_.pose(view));
  for (const BlockId view : blocks_.views) without.eliminate(view);
  without.hold(blocks_.views[size_t(gone)]);
  for (const Term& term : problem_.terms())
    if (term.group != gone && term.blocks[0] != blocks_.views[size_t(gone)]) without.addTerm(term);
  adjust(&without);

  const Eigen::VectorXd told = uncertainty.changeWithout(gone, {blocks_.points[7]}).value();
  const Eigen::VectorXd change = without.vector(blocks_.points[7]) - problem_.vector(blocks_.points[7]);
  EXPECT_LT((told - change).norm(), 0.05 * change.norm());
}

TEST(AdjustmentUncertainty, SaysWhatImagesLeaveOpen) {
  Random random(9);
  BundleBlocks blocks;
  AdjustmentProblem problem = bundleProblem(random, bundleWorld(random, 10, 3), 1e-3, &blocks);
  problem.hold(blocks.views[0]);  // all but the scale
  adjust(&problem);
  const AdjustmentUncertainty uncertainty(problem);
  EXPECT_FALSE(uncertainty.determined());
  EXPECT_FALSE(uncertainty.covariance({blocks.points[0]}).has_value());
  EXPECT_FALSE(uncertainty.sandwich({blocks.points[0]}).has_value());

  // All points together are free to grow and shrink about the held camera.
  const Eigen::MatrixXd information = uncertainty.information({blocks.points[0], blocks.points[1]});
  Eigen::VectorXd growth(6);
  const Eigen::Vector3d centre = problem.pose(blocks.views[0]).inverse().translation;
  growth << problem.vector(blocks.points[0]) - centre, problem.vector(blocks.points[1]) - centre;
  EXPECT_LT(growth.dot(information * growth), 1e-9 * information.norm() * growth.squaredNorm());
}

TEST(AdjustmentUncertainty, WhatIsHeldIsCertain) {
  Random random(10);
  AdjustmentProblem problem = lineProblem(lineData(random, 20, 0.1), 0.1);
  problem.hold(0, 1);
  adjust(&problem);
  const Eigen::MatrixXd covariance = AdjustmentUncertainty(problem).covariance({0}).value();
  EXPECT_NEAR(covariance(0, 0), 0.01 / 20, 1e-9);
  EXPECT_EQ(covariance(1, 1), 0);
  EXPECT_EQ(covariance(0, 1), 0);
}

}  // namespace
}  // namespace monocular_eye_hand
