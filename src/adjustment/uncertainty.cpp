#include "monocular_eye_hand/adjustment/uncertainty.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <set>

#include "adjustment/block_equations.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr double kOpen = 1e-12;  // an eigenvalue so much below the largest, with unit diagonal, is rounding

/// The inverse, by a matrix of unit diagonal; nothing when it is singular to rounding.
std::optional<Eigen::MatrixXd> inverseOf(const Eigen::MatrixXd& matrix) {
  if (matrix.rows() == 0) return matrix;
  if (!matrix.allFinite() || !(matrix.diagonal().minCoeff() > 0)) return {};
  const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * matrix *
                                                             scale.asDiagonal());
  const Eigen::VectorXd& values = eigen.eigenvalues();
  if (!(values[0] > kOpen * values[values.size() - 1])) return {};
  const Eigen::MatrixXd axes = scale.asDiagonal() * eigen.eigenvectors();
  return Eigen::MatrixXd(axes * values.cwiseInverse().asDiagonal() * axes.transpose());
}

/// The pseudo-inverse, what is open left out.
Eigen::MatrixXd pseudoInverseOf(const Eigen::MatrixXd& matrix) {
  if (matrix.rows() == 0) return matrix;
  const Eigen::VectorXd diagonal = matrix.diagonal();
  const Eigen::VectorXd scale = (diagonal.array() > 0).select(diagonal.cwiseSqrt().cwiseInverse(), 1.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * matrix *
                                                             scale.asDiagonal());
  const Eigen::VectorXd& values = eigen.eigenvalues();
  const double least = kOpen * values[values.size() - 1];
  const Eigen::VectorXd inverse = (values.array() > least).select(values.cwiseInverse(), 0.0);
  const Eigen::MatrixXd axes = scale.asDiagonal() * eigen.eigenvectors();
  return axes * inverse.asDiagonal() * axes.transpose();
}

Eigen::MatrixXd selected(const Eigen::MatrixXd& matrix, const std::vector<int>& rows,
                         const std::vector<int>& columns) {
  Eigen::MatrixXd out(int(rows.size()), int(columns.size()));
  for (size_t r = 0; r < rows.size(); ++r)
    for (size_t c = 0; c < columns.size(); ++c) out(int(r), int(c)) = matrix(rows[r], columns[c]);
  return out;
}

/// The one group whose terms see an eliminated block; -1 when there are several or none.
std::map<BlockId, int> groupsOfEliminated(const AdjustmentProblem& problem) {
  std::map<BlockId, std::set<int>> seen;
  for (const Term& term : problem.terms())
    for (const BlockId block : term.blocks)
      if (problem.eliminated(block) && term.group >= 0) seen[block].insert(term.group);

  std::map<BlockId, int> groups;
  for (const auto& [block, of_block] : seen) groups[block] = of_block.size() == 1 ? *of_block.begin() : -1;
  return groups;
}

/// The group that a term counts with: its own, or that of its eliminated block, so that what is known
/// beforehand of a view's own block goes with the view.
int groupOf(const Term& term, const std::map<BlockId, int>& of_eliminated) {
  if (term.group >= 0) return term.group;
  for (const BlockId block : term.blocks) {
    const auto found = of_eliminated.find(block);
    if (found != of_eliminated.end()) return found->second;
  }
  return -1;
}

}  // namespace

AdjustmentUncertainty::AdjustmentUncertainty(const AdjustmentProblem& problem) {
  const Layout layout(problem);
  first_ = layout.first;
  for (BlockId block = 0; block < problem.blocks(); ++block) {
    names_.push_back(problem.name(block));
    dimensions_.push_back(problem.dimension(block));
    free_.push_back(problem.freeCoordinates(block));
  }

  const AllEquations all = allEquations(problem, layout);
  if (!all.valid)
    throw BadInput("an adjustment's uncertainty was asked for where one of its terms makes no sense");
  Eigen::VectorXd unused;
  determined_ = reduce(all.equations, &information_, &unused);
  if (!determined_) {
    information_ = Eigen::MatrixXd::Zero(layout.columns, layout.columns);
    return;
  }

  const std::optional<Eigen::MatrixXd> inverse = inverseOf(information_);
  determined_ = inverse.has_value();
  if (inverse) covariance_ = *inverse;
  for (const auto& [block, part] : all.equations.eliminated) {
    const Eigen::LLT<Eigen::MatrixXd> llt(part.own);
    Eliminated& eliminated = eliminated_[block];
    eliminated.inverse = llt.solve(Eigen::MatrixXd::Identity(part.own.rows(), part.own.cols()));
    eliminated.change.setZero(part.own.rows(), layout.columns);
    for (const auto& [other, cross] : part.cross)
      eliminated.change.middleCols(layout.first[size_t(other)], cross.rows()) = -llt.solve(cross.transpose());
  }
  addShares(problem);
}

void AdjustmentUncertainty::addShares(const AdjustmentProblem& problem) {
  const Layout layout(problem);
  const std::map<BlockId, int> of_eliminated = groupsOfEliminated(problem);
  std::map<int, std::vector<const Term*>> terms;
  for (const Term& term : problem.terms()) {
    const int group = groupOf(term, of_eliminated);
    if (group >= 0) terms[group].push_back(&term);
  }

  for (const auto& [group, of_group] : terms) {
    BlockEquations equations(problem, layout);
    for (const Term* term : of_group) equations.add(problem, *term);
    Share& share = shares_[group];
    share.information = equations.information;
    share.gradient = equations.gradient;
    for (const auto& [block, part] : equations.eliminated) {
      const Eigen::MatrixXd& change = eliminated_.at(block).change;
      share.gradient += change.transpose() * part.gradient;
      const auto found = of_eliminated.find(block);
      if (found != of_eliminated.end() && found->second == group)
        share.information -= change.transpose() * part.own * change;
    }
  }
}

std::optional<Eigen::MatrixXd> AdjustmentUncertainty::covariance(const std::vector<BlockId>& blocks) const {
  if (!determined_) return {};
  // J C J^T with the derivatives J of the blocks by what stays, and for eliminated blocks what stays
  // uncertain of them where all else is known.
  const int rows = dimensionOf(blocks);
  Eigen::MatrixXd by_staying = Eigen::MatrixXd::Zero(rows, covariance_.rows());
  Eigen::MatrixXd own = Eigen::MatrixXd::Zero(rows, rows);

  int row = 0;
  for (const BlockId block : blocks) {
    const std::vector<int>& free = free_[size_t(block)];
    const auto found = eliminated_.find(block);
    for (size_t k = 0; k < free.size(); ++k) {
      if (found == eliminated_.end()) {
        by_staying(row + free[k], first_[size_t(block)] + int(k)) = 1;
        continue;
      }
      by_staying.row(row + free[k]) = found->second.change.row(int(k));
      for (size_t l = 0; l < free.size(); ++l)
        own(row + free[k], row + free[l]) = found->second.inverse(int(k), int(l));
    }
    row += dimensions_[size_t(block)];
  }
  const Eigen::MatrixXd sum = by_staying * covariance_ * by_staying.transpose() + own;
  return Eigen::MatrixXd(0.5 * (sum + sum.transpose()));
}

std::vector<int> AdjustmentUncertainty::columnsOf(const std::vector<BlockId>& blocks) const {
  std::vector<int> columns;
  for (const BlockId block : blocks) {
    if (eliminated_.count(block))
      throw BadInput(
          fmt::format("{} is eliminated: only its covariance can be asked for", names_.at(size_t(block))));
    for (size_t k = 0; k < free_.at(size_t(block)).size(); ++k)
      columns.push_back(first_[size_t(block)] + int(k));
  }
  return columns;
}

int AdjustmentUncertainty::dimensionOf(const std::vector<BlockId>& blocks) const {
  int rows = 0;
  for (const BlockId block : blocks) rows += dimensions_.at(size_t(block));
  return rows;
}

// Where the free coordinates stand among all, as columnsOf() has them among those of what stays.
std::vector<int> AdjustmentUncertainty::freeRowsOf(const std::vector<BlockId>& blocks) const {
  std::vector<int> rows;
  int first = 0;
  for (const BlockId block : blocks) {
    for (const int coordinate : free_.at(size_t(block))) rows.push_back(first + coordinate);
    first += dimensions_[size_t(block)];
  }
  return rows;
}

Eigen::MatrixXd AdjustmentUncertainty::information(const std::vector<BlockId>& blocks) const {
  const std::vector<int> own = columnsOf(blocks);
  std::vector<int> others;
  for (int column = 0; column < information_.cols(); ++column)
    if (std::find(own.begin(), own.end(), column) == own.end()) others.push_back(column);

  const Eigen::MatrixXd cross = selected(information_, own, others);
  const Eigen::MatrixXd marginal =
      selected(information_, own, own) -
      cross * pseudoInverseOf(selected(information_, others, others)) * cross.transpose();

  const std::vector<int> places = freeRowsOf(blocks);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(dimensionOf(blocks), dimensionOf(blocks));
  for (size_t r = 0; r < places.size(); ++r)
    for (size_t c = 0; c < places.size(); ++c) out(places[r], places[c]) = marginal(int(r), int(c));
  return 0.5 * (out + out.transpose());
}

std::vector<int> AdjustmentUncertainty::groups() const {
  std::vector<int> all;
  for (const auto& entry : shares_) all.push_back(entry.first);
  return all;
}

std::optional<Eigen::VectorXd> AdjustmentUncertainty::changeWithout(
    int group, const std::vector<BlockId>& blocks) const {
  const std::vector<int> columns = columnsOf(blocks);
  const auto share = shares_.find(group);
  if (share == shares_.end()) throw BadInput(fmt::format("the adjustment has no group {}", group));
  // At the optimum all gradients sum to zero, so that without the group -s of it is left.
  const std::optional<Eigen::MatrixXd> inverse = inverseOf(information_ - share->second.information);
  if (!inverse) return {};

  const Eigen::VectorXd change = *inverse * share->second.gradient;
  const std::vector<int> places = freeRowsOf(blocks);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(dimensionOf(blocks));
  for (size_t k = 0; k < places.size(); ++k) out[places[k]] = change[columns[k]];
  return out;
}

std::optional<Eigen::MatrixXd> AdjustmentUncertainty::sandwich(const std::vector<BlockId>& blocks) const {
  if (!determined_ || shares_.size() < 2) return {};
  Eigen::MatrixXd sum;
  for (const auto& entry : shares_) {
    const std::optional<Eigen::VectorXd> change = changeWithout(entry.first, blocks);
    if (!change) return {};
    if (sum.size() == 0) sum.setZero(change->size(), change->size());
    sum += *change * change->transpose();
  }
  return Eigen::MatrixXd(sum * (double(shares_.size() - 1) / double(shares_.size())));
}

}  // namespace monocular_eye_hand
