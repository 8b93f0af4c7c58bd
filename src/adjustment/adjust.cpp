#include "monocular_eye_hand/adjustment/adjust.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "adjustment/block_equations.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

double costOf(const AdjustmentProblem& problem, const std::vector<BlockValue>& values) {
  double cost = 0;
  for (const Term& term : problem.terms()) cost += costOf(term, values);
  return cost;
}

/// One step of all free coordinates, in the blocks' tangent spaces, and what it should gain.
struct Step {
  std::vector<Eigen::VectorXd> of_block;
  double decrease = 0;
};

Eigen::VectorXd inAllCoordinates(const AdjustmentProblem& problem, BlockId block,
                                 const Eigen::VectorXd& free) {
  const std::vector<int>& coordinates = problem.freeCoordinates(block);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(problem.dimension(block));
  for (size_t k = 0; k < coordinates.size(); ++k) all[coordinates[k]] = free[int(k)];
  return all;
}

/// What is added to the diagonal; a coordinate that no term fixes gets a little of the largest.
Eigen::VectorXd dampingOf(const Eigen::VectorXd& diagonal, double largest, double damping) {
  return damping * diagonal.array().max(1e-12 * largest);
}

double largestDiagonal(const BlockEquations& equations) {
  double largest = equations.information.size() ? equations.information.diagonal().maxCoeff() : 0;
  for (const auto& entry : equations.eliminated)
    largest = std::max(largest, entry.second.own.diagonal().maxCoeff());
  return largest;
}

/// What the quadratic model with this damping gains by the step d: 1/2 d^T (D d - g).
double modelDecrease(const Eigen::VectorXd& d, const Eigen::VectorXd& damping,
                     const Eigen::VectorXd& gradient) {
  return 0.5 * d.dot(damping.cwiseProduct(d) - gradient);
}

/// The damped step; false when the matrix is not positive definite to rounding.
bool stepOf(const AdjustmentProblem& problem, const BlockEquations& equations, double damping, Step* step) {
  const double largest = largestDiagonal(equations);
  const Eigen::VectorXd of_staying = dampingOf(equations.information.diagonal(), largest, damping);
  BlockEquations damped = equations;
  damped.information.diagonal() += of_staying;
  for (auto& entry : damped.eliminated) {
    Eigen::MatrixXd& own = entry.second.own;
    own.diagonal() += dampingOf(own.diagonal(), largest, damping);
  }

  Eigen::MatrixXd reduced;
  Eigen::VectorXd gradient;
  if (!reduce(damped, &reduced, &gradient)) return false;
  Eigen::VectorXd staying(equations.layout->columns);
  if (staying.size()) {
    const Eigen::VectorXd scale = reduced.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::LLT<Eigen::MatrixXd> llt(scale.asDiagonal() * reduced * scale.asDiagonal());
    if (llt.info() != Eigen::Success) return false;
    staying = -scale.cwiseProduct(llt.solve(scale.cwiseProduct(gradient)));
  }
  if (!staying.allFinite()) return false;

  step->of_block.assign(size_t(problem.blocks()), {});
  step->decrease = modelDecrease(staying, of_staying, equations.gradient);
  for (BlockId block = 0; block < problem.blocks(); ++block) {
    const int first = equations.layout->first[size_t(block)];
    const int free = int(problem.freeCoordinates(block).size());
    if (first >= 0)
      step->of_block[size_t(block)] = inAllCoordinates(problem, block, staying.segment(first, free));
  }

  for (const auto& [block, part] : damped.eliminated) {
    Eigen::VectorXd right = part.gradient;
    for (const auto& [other, cross] : part.cross)
      right += cross.transpose() * staying.segment(equations.layout->first[size_t(other)], cross.rows());
    const Eigen::VectorXd d = -part.own.llt().solve(right);
    const Eigen::VectorXd of_own = part.own.diagonal() - equations.eliminated.at(block).own.diagonal();
    step->decrease += modelDecrease(d, of_own, part.gradient);
    step->of_block[size_t(block)] = inAllCoordinates(problem, block, d);
  }
  return true;
}

std::vector<BlockValue> stepped(const AdjustmentProblem& problem, const Step& step) {
  std::vector<BlockValue> values = problem.values();
  for (size_t block = 0; block < values.size(); ++block)
    if (step.of_block[block].size()) values[block] = moved(values[block], step.of_block[block]);
  return values;
}

void setAll(AdjustmentProblem* problem, const std::vector<BlockValue>& values) {
  for (BlockId block = 0; block < problem->blocks(); ++block) problem->set(block, values[size_t(block)]);
}

/// Rotations stay rotations however many steps were multiplied.
void orthonormalise(AdjustmentProblem* problem) {
  for (BlockId block = 0; block < problem->blocks(); ++block) {
    if (problem->freeCoordinates(block).empty()) continue;
    if (const auto* pose = std::get_if<Rigid3>(&problem->values()[size_t(block)]))
      problem->set(block, Rigid3{nearestRotation(pose->rotation), pose->translation});
  }
}

}  // namespace

void AdjustmentOptions::check() const {
  require(max_iterations >= 1, "max_iterations", max_iterations, "at least 1");
  requirePositive("min_decrease", min_decrease);
  requirePositive("first_damping", first_damping);
}

double costOf(const AdjustmentProblem& problem) { return costOf(problem, problem.values()); }

AdjustmentReport adjust(AdjustmentProblem* problem, const AdjustmentOptions& options) {
  options.check();
  AdjustmentReport report;
  const Layout layout(*problem);
  AllEquations now = allEquations(*problem, layout);
  report.first_cost = report.cost = costOf(*problem);
  if (!now.valid) return report;

  double damping = options.first_damping;
  double growth = 2;
  report.end = AdjustmentEnd::kMaxIterations;
  while (report.iterations < options.max_iterations) {
    ++report.iterations;
    Step step;
    const bool solved = stepOf(*problem, now.equations, damping, &step);
    // A part of the cost's own size is what rounding makes of it.
    if (solved && step.decrease < options.min_decrease + 1e-14 * report.cost) {
      report.end = AdjustmentEnd::kConverged;
      break;
    }

    const std::vector<BlockValue> next = solved ? stepped(*problem, step) : problem->values();
    const double cost = costOf(*problem, next);
    if (cost < report.cost) {
      const double gain = (report.cost - cost) / step.decrease;
      setAll(problem, next);
      report.cost = cost;
      now = allEquations(*problem, layout);
      if (!now.valid) break;
      damping *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
      growth = 2;
      continue;
    }

    damping *= growth;
    growth *= 2;
    if (damping > 1e16) {
      report.end = AdjustmentEnd::kStuck;
      break;
    }
  }
  orthonormalise(problem);
  return report;
}

}  // namespace monocular_eye_hand
