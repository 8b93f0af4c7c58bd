#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/pose/matches.h"

namespace monocular_eye_hand {

/// Weighted normal equations of the pose and the sums that describe the residuals' distribution.
struct NormalEquations {
  Matrix6d hessian = Matrix6d::Zero();  ///< sum w J^T J / sigma^2
  Vector6d gradient = Vector6d::Zero();
  double cost = 0;       ///< sum of rho(residual / sigma)
  double inliers = 0;    ///< sum of weights, one per match
  int residuals = 0;     ///< with a weight above 0: one per line match, two per point match
  double weights = 0;    ///< sum w, per residual
  double influence = 0;  ///< sum psi^2
  double slope = 0;      ///< sum psi'
  double square_px = 0;  ///< sum w r^2 [px^2], per residual

  double rms() const;
  /// Variance factor of the inverse hessian: that of an M-estimate (Huber 1981, 7.6) with n - unknowns
  /// degrees of freedom; 1 without redundancy.
  double variance(int unknowns) const;
};

/// The residuals of all matches at a pose, and what follows from them. Allocates once.
class MatchResiduals {
 public:
  MatchResiduals(const Camera& camera, const std::vector<LineMatch>& lines,
                 const std::vector<PointMatch>& points);
  void evaluate(const Rigid3& camera_from_object);
  /// Robust standard deviation of the residuals in units of their sigmas, at least 1.
  double scale();
  /// Tukey's loss with the cut-off [sigmas]; least squares when 0 (infinite cost behind the camera then).
  NormalEquations accumulate(double cut) const;

 private:
  struct Row {  // residuals and derivatives by the point's position, all divided by sigma
    double r0, r1;
    Eigen::Vector3d a0, a1, rotated;
    double square;  // r0^2 + r1^2; negative behind the camera
  };
  const Camera& camera_;
  const std::vector<LineMatch>& lines_;
  const std::vector<PointMatch>& points_;
  std::vector<Row> rows_;
  std::vector<double> sizes_;
};

}  // namespace monocular_eye_hand
