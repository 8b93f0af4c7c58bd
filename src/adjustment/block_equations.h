#pragma once
#include <Eigen/Core>
#include <map>
#include <vector>

#include "monocular_eye_hand/adjustment/problem.h"

namespace monocular_eye_hand {

/// Where the free coordinates of each block stand: of those that stay among all that stay, of an eliminated
/// one alone.
struct Layout {
  explicit Layout(const AdjustmentProblem& problem);
  std::vector<int> first;  ///< of a block that stays: its first column; -1 of others and of held ones
  std::vector<BlockId> eliminated;  ///< with free coordinates
  int columns = 0;
};

/// What the terms say of an eliminated block and of it with those that stay.
struct EliminatedPart {
  Eigen::MatrixXd own;
  Eigen::VectorXd gradient;
  std::map<BlockId, Eigen::MatrixXd> cross;  ///< free coordinates of a block that stays x the own ones
};

/// H d = -g of all terms, or of some, at the problem's values. H is J^T W J, with the losses' weights.
struct BlockEquations {
  BlockEquations(const AdjustmentProblem& problem, const Layout& layout);
  /// Adds a term; false where it makes no sense.
  bool add(const AdjustmentProblem& problem, const Term& term);

  const Layout* layout;
  Eigen::MatrixXd information;  ///< of what stays
  Eigen::VectorXd gradient;
  std::map<BlockId, EliminatedPart> eliminated;
  double cost = 0;
};

/// Of all terms. `valid` is false, and the rest not filled, where one makes no sense.
struct AllEquations {
  BlockEquations equations;
  bool valid = true;
};
AllEquations allEquations(const AdjustmentProblem& problem, const Layout& layout);

/// The system of what stays, the eliminated blocks at their best: S = H - sum C E^-1 C^T, s = g - sum C E^-1
/// e. False when a matrix E is not positive definite.
bool reduce(const BlockEquations& equations, Eigen::MatrixXd* information, Eigen::VectorXd* gradient);

/// A term's cost at the values; infinity where it makes no sense.
double costOf(const Term& term, const std::vector<BlockValue>& values);

}  // namespace monocular_eye_hand
