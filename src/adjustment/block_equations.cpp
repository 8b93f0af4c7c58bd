#include "adjustment/block_equations.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace monocular_eye_hand {
namespace {

TermValues valuesOf(const Term& term, const std::vector<BlockValue>& values) {
  std::vector<const BlockValue*> own;
  for (const BlockId block : term.blocks) own.push_back(&values[size_t(block)]);
  return TermValues(std::move(own));
}

/// Evaluates a term and scales each error by the root of its weight; returns the cost, infinity where there
/// is none.
double evaluate(const Term& term, const TermValues& at, bool derivatives, TermErrors* errors) {
  errors->residuals.resize(term.residuals);
  if (!term.evaluate(at, derivatives, errors) || !errors->residuals.allFinite())
    return std::numeric_limits<double>::infinity();

  double cost = 0;
  const int rows = term.residuals_per_error;
  for (int first = 0; first < term.residuals; first += rows) {
    const double squared = errors->residuals.segment(first, rows).squaredNorm();
    cost += 0.5 * term.loss.cost(squared);
    if (!derivatives || term.loss.kind == RobustLoss::Kind::kSquares) continue;
    const double root = std::sqrt(term.loss.weight(squared));
    errors->residuals.segment(first, rows) *= root;
    for (Eigen::MatrixXd& jacobian : errors->jacobians) jacobian.middleRows(first, rows) *= root;
  }
  return cost;
}

/// The columns of the coordinates that may change.
Eigen::MatrixXd freeColumns(const Eigen::MatrixXd& jacobian, const std::vector<int>& free) {
  if (int(free.size()) == jacobian.cols()) return jacobian;
  Eigen::MatrixXd columns(jacobian.rows(), int(free.size()));
  for (size_t k = 0; k < free.size(); ++k) columns.col(int(k)) = jacobian.col(free[k]);
  return columns;
}

}  // namespace

Layout::Layout(const AdjustmentProblem& problem) {
  for (BlockId block = 0; block < problem.blocks(); ++block) {
    const int free = int(problem.freeCoordinates(block).size());
    const bool stays = free > 0 && !problem.eliminated(block);
    first.push_back(stays ? columns : -1);
    if (stays) columns += free;
    if (free > 0 && problem.eliminated(block)) eliminated.push_back(block);
  }
}

BlockEquations::BlockEquations(const AdjustmentProblem& problem, const Layout& of) : layout(&of) {
  information.setZero(of.columns, of.columns);
  gradient.setZero(of.columns);
  for (const BlockId block : of.eliminated) {
    const int free = int(problem.freeCoordinates(block).size());
    EliminatedPart& part = eliminated[block];
    part.own.setZero(free, free);
    part.gradient.setZero(free);
  }
}

bool BlockEquations::add(const AdjustmentProblem& problem, const Term& term) {
  TermErrors errors;
  for (const BlockId block : term.blocks)
    errors.jacobians.emplace_back(Eigen::MatrixXd::Zero(term.residuals, problem.dimension(block)));
  const double term_cost = evaluate(term, valuesOf(term, problem.values()), true, &errors);
  if (!std::isfinite(term_cost)) return false;
  cost += term_cost;

  std::vector<BlockId> staying;
  std::vector<Eigen::MatrixXd> jacobians;
  EliminatedPart* part = nullptr;
  Eigen::MatrixXd part_jacobian;
  for (size_t k = 0; k < term.blocks.size(); ++k) {
    const BlockId block = term.blocks[k];
    if (problem.freeCoordinates(block).empty()) continue;
    Eigen::MatrixXd jacobian = freeColumns(errors.jacobians[k], problem.freeCoordinates(block));
    if (problem.eliminated(block)) {
      part = &eliminated.at(block);
      part_jacobian = std::move(jacobian);
    } else {
      staying.push_back(block);
      jacobians.push_back(std::move(jacobian));
    }
  }

  for (size_t a = 0; a < staying.size(); ++a) {
    const int row = layout->first[size_t(staying[a])];
    gradient.segment(row, jacobians[a].cols()) += jacobians[a].transpose() * errors.residuals;
    for (size_t b = 0; b < staying.size(); ++b)
      information.block(row, layout->first[size_t(staying[b])], jacobians[a].cols(), jacobians[b].cols()) +=
          jacobians[a].transpose() * jacobians[b];
  }
  if (!part) return true;

  part->own += part_jacobian.transpose() * part_jacobian;
  part->gradient += part_jacobian.transpose() * errors.residuals;
  for (size_t a = 0; a < staying.size(); ++a) {
    Eigen::MatrixXd& cross = part->cross[staying[a]];
    if (cross.size() == 0) cross.setZero(jacobians[a].cols(), part_jacobian.cols());
    cross += jacobians[a].transpose() * part_jacobian;
  }
  return true;
}

AllEquations allEquations(const AdjustmentProblem& problem, const Layout& layout) {
  AllEquations all{BlockEquations(problem, layout), true};
  for (const Term& term : problem.terms()) {
    all.valid = all.equations.add(problem, term);
    if (!all.valid) break;
  }
  return all;
}

bool reduce(const BlockEquations& equations, Eigen::MatrixXd* information, Eigen::VectorXd* gradient) {
  *information = equations.information;
  *gradient = equations.gradient;
  for (const auto& entry : equations.eliminated) {
    const EliminatedPart& part = entry.second;
    const Eigen::LLT<Eigen::MatrixXd> llt(part.own);
    if (llt.info() != Eigen::Success) return false;
    const Eigen::VectorXd best = llt.solve(part.gradient);

    for (const auto& [a, cross_a] : part.cross) {
      const int row = equations.layout->first[size_t(a)];
      const Eigen::MatrixXd weighted = llt.solve(cross_a.transpose());
      gradient->segment(row, cross_a.rows()) -= cross_a * best;
      for (const auto& [b, cross_b] : part.cross)
        information->block(equations.layout->first[size_t(b)], row, cross_b.rows(), cross_a.rows()) -=
            cross_b * weighted;
    }
  }
  return true;
}

double costOf(const Term& term, const std::vector<BlockValue>& values) {
  TermErrors errors;
  return evaluate(term, valuesOf(term, values), false, &errors);
}

}  // namespace monocular_eye_hand
