#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "monocular_eye_hand/adjustment/loss.h"
#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// Numbers or a pose that belong together: an index into a problem.
using BlockId = int;

/// A block's value: numbers, changed by addition, or a transform, changed by perturbed().
using BlockValue = std::variant<Eigen::VectorXd, Rigid3>;

/// The values of a term's blocks, in the order in which the term names them.
class TermValues {
 public:
  explicit TermValues(std::vector<const BlockValue*> values) : values_(std::move(values)) {}
  const Eigen::VectorXd& vector(int k) const { return std::get<Eigen::VectorXd>(value(k)); }
  const Rigid3& pose(int k) const { return std::get<Rigid3>(value(k)); }
  const BlockValue& value(int k) const { return *values_.at(size_t(k)); }
  int size() const { return int(values_.size()); }

 private:
  std::vector<const BlockValue*> values_;
};

/// A term's residuals, each divided by its standard deviation, and their derivatives. Sizes are set by the
/// caller.
struct TermErrors {
  Eigen::VectorXd residuals;
  std::vector<Eigen::MatrixXd> jacobians;  ///< one a block: residuals x numbers, or x 6 of perturbed()'s d
};

/// Fills `errors`, its derivatives only when they are asked for. Returns false where the values make no sense
/// (a point behind the camera): a step there is not taken.
using TermFunction = std::function<bool(const TermValues& at, bool derivatives, TermErrors* errors)>;

/// Measurements that depend on the same blocks.
struct Term {
  std::vector<BlockId> blocks;  ///< each once
  int residuals = 0;
  int residuals_per_error = 1;  ///< so many, in a row, are one error with one loss: 2 of a point in an image
  RobustLoss loss;
  /// What shares causes of error, such as all points of one view; the sandwich and the influences go by it.
  /// Those below 0 (what was known before) are in none.
  int group = -1;
  TermFunction evaluate;
};

/// A non-linear least-squares problem: blocks, and terms between them. The cost is half of the sum of the
/// losses of all errors. It is a value: a copy can be changed and adjusted on its own.
class AdjustmentProblem {
 public:
  /// Both throw BadInput when the start is not finite. `name` is for messages and figures.
  BlockId addVector(const std::string& name, const Eigen::VectorXd& start);
  BlockId addPose(const std::string& name, const Rigid3& start);
  /// Throws BadInput when the term names a block twice or one that is not there, has no residuals or none for
  /// each of its errors, or names two eliminated blocks.
  void addTerm(Term term);

  /// What is known of a block beforehand: its value `mean` with a covariance, of a pose as of perturbed()'s d
  /// from the mean. Throws BadInput when the covariance is not positive definite.
  void addPrior(BlockId block, const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance);
  void addPrior(BlockId block, const Rigid3& mean, const Matrix6d& covariance);

  /// The block, or one of its coordinates, keeps its value.
  void hold(BlockId block);
  void hold(BlockId block, int coordinate);
  /// The block is solved for by the Schur complement: cheap for many blocks that meet only others in their
  /// terms, such as the pose of each view. Throws BadInput when a term has another such block.
  void eliminate(BlockId block);

  const Eigen::VectorXd& vector(BlockId block) const {
    return std::get<Eigen::VectorXd>(values_.at(size_t(block)));
  }
  const Rigid3& pose(BlockId block) const { return std::get<Rigid3>(values_.at(size_t(block))); }
  void set(BlockId block, const BlockValue& value) { values_.at(size_t(block)) = value; }

  int blocks() const { return int(values_.size()); }
  const std::string& name(BlockId block) const { return names_.at(size_t(block)); }
  int dimension(BlockId block) const;  ///< of its tangent space: 6 of a pose
  const std::vector<int>& freeCoordinates(BlockId block) const { return free_.at(size_t(block)); }
  bool eliminated(BlockId block) const { return eliminated_.at(size_t(block)); }
  const std::vector<Term>& terms() const { return terms_; }
  const std::vector<BlockValue>& values() const { return values_; }

 private:
  BlockId add(const std::string& name, const BlockValue& start);
  void requireOneEliminated(const Term& term) const;

  std::vector<BlockValue> values_;
  std::vector<std::string> names_;
  std::vector<std::vector<int>> free_;  // coordinates that may change
  std::vector<bool> eliminated_;
  std::vector<Term> terms_;
};

/// The value after a small motion of all coordinates of its tangent space.
BlockValue moved(const BlockValue& value, const Eigen::VectorXd& step);

/// Derivatives by central differences for residuals that have none of their own.
using ResidualFunction = std::function<bool(const TermValues& at, Eigen::VectorXd* residuals)>;
TermFunction withNumericJacobians(ResidualFunction residuals);

}  // namespace monocular_eye_hand
