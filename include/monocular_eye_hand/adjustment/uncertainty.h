#pragma once
#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "monocular_eye_hand/adjustment/problem.h"

namespace monocular_eye_hand {

/// How well an adjusted problem fixes its blocks, at its values. Matrices and vectors are over all
/// coordinates of the blocks asked for, in that order; those that are held have zeros. First order.
class AdjustmentUncertainty {
 public:
  /// Throws BadInput when a term makes no sense at the problem's values.
  explicit AdjustmentUncertainty(const AdjustmentProblem& problem);

  /// Whether the terms fix every coordinate that may change. Without it there are no covariances.
  bool determined() const { return determined_; }

  /// The covariance when every residual has the standard deviation that it was divided by; of eliminated
  /// blocks, too.
  std::optional<Eigen::MatrixXd> covariance(const std::vector<BlockId>& blocks) const;

  /// What the terms say of these blocks, everything else being at its best for each of their values: the
  /// inverse of covariance(), and singular where they leave a direction open. Blocks that are not eliminated.
  Eigen::MatrixXd information(const std::vector<BlockId>& blocks) const;

  /// The covariance by the spread of the groups, whatever the standard deviations told: the delete-one
  /// jackknife over groups in first order (MacKinnon and White 1985, HC3; Bell and McCaffrey 2002, CR3).
  /// Nothing with fewer than two groups, or when the others do not fix all without one. Blocks that are not
  /// eliminated.
  std::optional<Eigen::MatrixXd> sandwich(const std::vector<BlockId>& blocks) const;

  /// The groups of the problem's terms, ascending.
  std::vector<int> groups() const;

  /// How the blocks would change without a group. Nothing when the others do not fix all. Blocks that are not
  /// eliminated.
  std::optional<Eigen::VectorXd> changeWithout(int group, const std::vector<BlockId>& blocks) const;

 private:
  /// What a group, and the eliminated blocks that only it sees, say of what stays.
  struct Share {
    Eigen::MatrixXd information;
    Eigen::VectorXd gradient;
  };
  struct Eliminated {
    Eigen::MatrixXd inverse;  ///< of what its terms say of it
    Eigen::MatrixXd change;   ///< of its free coordinates by those of what stays
  };
  void addShares(const AdjustmentProblem& problem);
  int dimensionOf(const std::vector<BlockId>& blocks) const;
  std::vector<int> freeRowsOf(const std::vector<BlockId>& blocks) const;
  std::vector<int> columnsOf(const std::vector<BlockId>& blocks) const;

  std::vector<std::string> names_;
  std::vector<int> dimensions_, first_;
  std::vector<std::vector<int>> free_;
  Eigen::MatrixXd information_, covariance_;  ///< of what stays
  std::map<BlockId, Eliminated> eliminated_;
  std::map<int, Share> shares_;
  bool determined_ = false;
};

}  // namespace monocular_eye_hand
