#include "monocular_eye_hand/adjustment/problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fits.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

Term termOf(const std::vector<BlockId>& blocks) {
  Term term;
  term.blocks = blocks;
  term.residuals = 1;
  term.evaluate = [](const TermValues&, bool, TermErrors*) { return true; };
  return term;
}

TEST(AdjustmentProblem, RefusesTermsThatItCannotHold) {
  AdjustmentProblem problem;
  const BlockId a = problem.addVector("the focal length", Eigen::VectorXd::Ones(2));
  const BlockId b = problem.addPose("the hand-eye", {});
  const auto refused = [&](const Term& term) { return refusal([&] { problem.addTerm(term); }); };

  EXPECT_EQ(refused(termOf({a, b})), kAccepted);
  EXPECT_THAT(refused(termOf({})), HasSubstr("does not have"));
  EXPECT_THAT(refused(termOf({a, 2})), HasSubstr("does not have"));
  EXPECT_THAT(refused(termOf({b, b})), HasSubstr("the hand-eye"));
  Term odd = termOf({a});
  odd.residuals = 3;
  odd.residuals_per_error = 2;
  EXPECT_THAT(refused(odd), HasSubstr("3 residuals, 2 an error"));
  Term empty = termOf({a});
  empty.evaluate = nullptr;
  EXPECT_THAT(refused(empty), HasSubstr("no function"));
  Term narrow = termOf({a});
  narrow.loss = RobustLoss::huber(0);
  EXPECT_THAT(refused(narrow), HasSubstr("width"));
}

TEST(AdjustmentProblem, TwoEliminatedBlocksMayNotMeet) {
  AdjustmentProblem problem;
  const BlockId a = problem.addPose("view 1", {}), b = problem.addPose("view 2", {});
  problem.eliminate(a);
  problem.addTerm(termOf({a, b}));
  EXPECT_THAT(refusal([&] { problem.eliminate(b); }), HasSubstr("view 1 and view 2 meet"));
}

TEST(AdjustmentProblem, RefusesStartsAndKnowledgeThatMakeNoSense) {
  AdjustmentProblem problem;
  EXPECT_THAT(refusal([&] { problem.addVector("f", Eigen::VectorXd::Constant(1, NAN)); }),
              HasSubstr("f begins"));
  const BlockId f = problem.addVector("f", Eigen::VectorXd::Constant(2, 500));
  EXPECT_THAT(
      refusal([&] { problem.addPrior(f, Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1)); }),
      HasSubstr("2 numbers"));
  EXPECT_THAT(refusal([&] { problem.addPrior(f, Eigen::Vector2d(1, 1), Eigen::Matrix2d::Zero()); }),
              HasSubstr("not positive definite"));
}

// Analytic derivatives against differences: of the given term at the problem's values.
void expectTrueDerivatives(const AdjustmentProblem& problem, const Term& term) {
  std::vector<const BlockValue*> values;
  TermErrors analytic, numeric;
  for (const BlockId block : term.blocks) {
    values.push_back(&problem.values()[size_t(block)]);
    analytic.jacobians.emplace_back(Eigen::MatrixXd::Zero(term.residuals, problem.dimension(block)));
  }
  numeric = analytic;
  analytic.residuals.resize(term.residuals);
  numeric.residuals.resize(term.residuals);
  ASSERT_TRUE(term.evaluate(TermValues(values), true, &analytic));
  const TermFunction by_differences =
      withNumericJacobians([&](const TermValues& at, Eigen::VectorXd* residuals) {
        TermErrors errors;
        errors.residuals.resize(term.residuals);
        const bool valid = term.evaluate(at, false, &errors);
        *residuals = errors.residuals;
        return valid;
      });
  ASSERT_TRUE(by_differences(TermValues(values), true, &numeric));
  for (size_t k = 0; k < term.blocks.size(); ++k)
    EXPECT_TRUE(analytic.jacobians[k].isApprox(numeric.jacobians[k], 1e-6))
        << analytic.jacobians[k] << "\nby differences\n"
        << numeric.jacobians[k];
}

TEST(AdjustmentProblem, KnowledgeOfAPoseHasTrueDerivativesFarFromItsMean) {
  Random random(3);
  for (const double angle : {1e-6, 0.3, 2.0, 3.0}) {
    AdjustmentProblem problem;
    const Rigid3 mean{randomRotation(random), randomVector(random)};
    Vector6d d;
    d << randomVector(random), angle * randomDirection(random);
    const BlockId pose = problem.addPose("pose", perturbed(mean, d));
    Vector6d variances;
    variances << 1, 2, 3, 4, 5, 6;
    problem.addPrior(pose, mean, variances.asDiagonal());
    expectTrueDerivatives(problem, problem.terms().front());
  }
}

TEST(AdjustmentProblem, TheTestsOwnBundleHasTrueDerivatives) {
  Random random(4);
  BundleBlocks blocks;
  const AdjustmentProblem problem = bundleProblem(random, bundleWorld(random, 3, 2), 0.01, &blocks);
  for (const Term& term : problem.terms()) expectTrueDerivatives(problem, term);
}

}  // namespace
}  // namespace monocular_eye_hand
