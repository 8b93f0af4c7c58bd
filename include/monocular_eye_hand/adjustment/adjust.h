#pragma once
#include "monocular_eye_hand/adjustment/problem.h"

namespace monocular_eye_hand {

struct AdjustmentOptions {
  int max_iterations = 100;
  /// Ends when a step is expected to lower the cost by less: a parameter that is one standard deviation off
  /// costs 0.5.
  double min_decrease = 1e-10;
  double first_damping = 1e-4;  ///< of Marquardt's, in units of the normal equations' diagonal

  void check() const;
};

enum class AdjustmentEnd {
  kConverged,
  kMaxIterations,
  kStuck,     ///< no step lowers the cost, however short
  kBadStart,  ///< a term makes no sense where it begins: nothing was changed
};

struct AdjustmentReport {
  AdjustmentEnd end = AdjustmentEnd::kBadStart;
  int iterations = 0;
  double first_cost = 0;
  double cost = 0;
  bool converged() const { return end == AdjustmentEnd::kConverged; }
};

/// Levenberg-Marquardt with Marquardt's scaling and Nielsen's damping (Madsen, Nielsen, Tingleff 2004,
/// Methods for Non-linear Least Squares Problems, 3.2), robust losses by reweighting, eliminated blocks by
/// the Schur complement. Leaves the best values found in `problem`. The same problem gives the same values.
/// Throws BadInput when an option is out of range.
AdjustmentReport adjust(AdjustmentProblem* problem, const AdjustmentOptions& options = {});

/// Half of the sum of all losses; infinity where a term makes no sense.
double costOf(const AdjustmentProblem& problem);

}  // namespace monocular_eye_hand
