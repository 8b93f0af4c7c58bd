#pragma once

namespace monocular_eye_hand {

/// What an error costs of which it is known that some are wrong altogether. An error is a vector of residuals
/// in standard deviations, e of length |e|; its cost is half of rho(|e|^2).
struct RobustLoss {
  enum class Kind { kSquares, kHuber, kCauchy };
  Kind kind = Kind::kSquares;
  double width = 0;  ///< where it leaves the parabola [standard deviations]

  static RobustLoss squares() { return {}; }
  static RobustLoss huber(double width) { return {Kind::kHuber, width}; }
  static RobustLoss cauchy(double width) { return {Kind::kCauchy, width}; }

  /// rho(s) of the squared length s: s, 2 w sqrt(s) - w^2 beyond w^2, w^2 log(1 + s / w^2).
  double cost(double squared_length) const;
  /// Its derivative: the weight of an error in the normal equations (iteratively reweighted least squares).
  double weight(double squared_length) const;
  /// Throws BadInput when the width of a robust loss is not positive.
  void check() const;
};

}  // namespace monocular_eye_hand
