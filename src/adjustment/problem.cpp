#include "monocular_eye_hand/adjustment/problem.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

bool finite(const BlockValue& value) {
  if (const auto* pose = std::get_if<Rigid3>(&value)) return pose->isFinite();
  return std::get<Eigen::VectorXd>(value).allFinite();
}

int tangentDimension(const BlockValue& value) {
  return std::holds_alternative<Rigid3>(value) ? 6 : int(std::get<Eigen::VectorXd>(value).size());
}

/// The cube root of the rounding error is best for central differences.
double numericStep(const BlockValue& value, int coordinate) {
  const auto* numbers = std::get_if<Eigen::VectorXd>(&value);
  return 6e-6 * (numbers ? std::max(1.0, std::abs((*numbers)[coordinate])) : 1);
}

/// L^-1 of the covariance L L^T: whitens what has this covariance.
Eigen::MatrixXd whitening(const Eigen::MatrixXd& covariance, const std::string& name) {
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  if (!covariance.allFinite() || llt.info() != Eigen::Success)
    throw BadInput(
        fmt::format("the covariance known of {} is not positive definite: give a variance to each of its "
                    "coordinates, or hold those that are known exactly",
                    name));
  return llt.matrixL().solve(Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols()));
}

/// Derivative of logSO3(Exp(d) R) by d at d = 0, where w = logSO3(R): the inverse of the left Jacobian of
/// SO(3).
Eigen::Matrix3d inverseLeftJacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d k = skew(w);
  const double third = angle < 1e-4 ? 1.0 / 12 : 1 / (angle * angle) - 1 / (2 * angle * std::tan(angle / 2));
  return Eigen::Matrix3d::Identity() - 0.5 * k + third * k * k;
}

}  // namespace

BlockId AdjustmentProblem::add(const std::string& name, const BlockValue& start) {
  if (!finite(start)) throw BadInput(fmt::format("{} begins with a number that is not finite", name));

  values_.push_back(start);
  names_.push_back(name);
  free_.emplace_back(size_t(tangentDimension(start)));
  std::iota(free_.back().begin(), free_.back().end(), 0);
  eliminated_.push_back(false);
  return blocks() - 1;
}

BlockId AdjustmentProblem::addVector(const std::string& name, const Eigen::VectorXd& start) {
  return add(name, start);
}

BlockId AdjustmentProblem::addPose(const std::string& name, const Rigid3& start) { return add(name, start); }

int AdjustmentProblem::dimension(BlockId block) const { return tangentDimension(values_.at(size_t(block))); }

void AdjustmentProblem::requireOneEliminated(const Term& term) const {
  BlockId first = -1;
  for (const BlockId block : term.blocks) {
    if (!eliminated(block)) continue;
    if (first >= 0)
      throw BadInput(fmt::format("{} and {} meet in one term: they cannot both be eliminated", name(first),
                                 name(block)));
    first = block;
  }
}

void AdjustmentProblem::addTerm(Term term) {
  std::vector<BlockId> sorted = term.blocks;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty() || sorted.front() < 0 || sorted.back() >= blocks())
    throw BadInput("a term names a block that the problem does not have");
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    throw BadInput(fmt::format("a term names a block twice, {} among them", name(sorted.front())));
  if (term.residuals < 1 || term.residuals_per_error < 1 || term.residuals % term.residuals_per_error != 0)
    throw BadInput(fmt::format("a term of {} has {} residuals, {} an error", name(term.blocks.front()),
                               term.residuals, term.residuals_per_error));
  if (!term.evaluate) throw BadInput(fmt::format("a term of {} has no function", name(term.blocks.front())));
  term.loss.check();
  requireOneEliminated(term);

  terms_.push_back(std::move(term));
}

void AdjustmentProblem::addPrior(BlockId block, const Eigen::VectorXd& mean,
                                 const Eigen::MatrixXd& covariance) {
  if (mean.size() != dimension(block) || covariance.rows() != mean.size() || covariance.cols() != mean.size())
    throw BadInput(fmt::format("what is known of {} has another size than its {} numbers", name(block),
                               dimension(block)));

  const Eigen::MatrixXd whitened = whitening(covariance, name(block));
  Term prior;
  prior.blocks = {block};
  prior.residuals = prior.residuals_per_error = int(mean.size());
  prior.evaluate = [mean, whitened](const TermValues& at, bool derivatives, TermErrors* errors) {
    errors->residuals = whitened * (at.vector(0) - mean);
    if (derivatives) errors->jacobians[0] = whitened;
    return true;
  };
  addTerm(std::move(prior));
}

void AdjustmentProblem::addPrior(BlockId block, const Rigid3& mean, const Matrix6d& covariance) {
  const Eigen::MatrixXd whitened = whitening(covariance, name(block));
  Term prior;
  prior.blocks = {block};
  prior.residuals = prior.residuals_per_error = 6;
  prior.evaluate = [mean, whitened](const TermValues& at, bool derivatives, TermErrors* errors) {
    const Vector6d d = difference(mean, at.pose(0));
    errors->residuals = whitened * d;
    if (derivatives) {
      Matrix6d change = Matrix6d::Identity();
      change.bottomRightCorner<3, 3>() = inverseLeftJacobian(d.tail<3>());
      errors->jacobians[0] = whitened * change;
    }
    return true;
  };
  addTerm(std::move(prior));
}

void AdjustmentProblem::hold(BlockId block) { free_.at(size_t(block)).clear(); }

void AdjustmentProblem::hold(BlockId block, int coordinate) {
  std::vector<int>& free = free_.at(size_t(block));
  free.erase(std::remove(free.begin(), free.end(), coordinate), free.end());
}

void AdjustmentProblem::eliminate(BlockId block) {
  eliminated_.at(size_t(block)) = true;
  for (const Term& term : terms_) requireOneEliminated(term);
}

BlockValue moved(const BlockValue& value, const Eigen::VectorXd& step) {
  if (const auto* pose = std::get_if<Rigid3>(&value)) return perturbed(*pose, Vector6d(step));
  return Eigen::VectorXd(std::get<Eigen::VectorXd>(value) + step);
}

TermFunction withNumericJacobians(ResidualFunction residuals) {
  return [residuals = std::move(residuals)](const TermValues& at, bool derivatives, TermErrors* errors) {
    if (!residuals(at, &errors->residuals)) return false;
    if (!derivatives) return true;

    std::vector<BlockValue> values;
    std::vector<const BlockValue*> pointers;
    for (int k = 0; k < at.size(); ++k) values.push_back(at.value(k));
    for (const BlockValue& value : values) pointers.push_back(&value);
    const TermValues stepped(pointers);
    Eigen::VectorXd after = errors->residuals;
    Eigen::VectorXd before = errors->residuals;

    for (size_t k = 0; k < values.size(); ++k) {
      const BlockValue here = values[k];
      for (int c = 0; c < tangentDimension(here); ++c) {
        const Eigen::VectorXd step = Eigen::VectorXd::Unit(tangentDimension(here), c) * numericStep(here, c);
        values[k] = moved(here, step);
        if (!residuals(stepped, &after)) return false;
        values[k] = moved(here, -step);
        if (!residuals(stepped, &before)) return false;
        errors->jacobians[k].col(c) = (after - before) / (2 * step[c]);
      }
      values[k] = here;
    }
    return true;
  };
}

}  // namespace monocular_eye_hand
