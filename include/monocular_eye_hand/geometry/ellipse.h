#pragma once
#include <Eigen/Core>

namespace monocular_eye_hand {

/// Ellipse (Wong et al., eq. 2) in pixels: semi-axes a >= b > 0, `angle` [rad] of the a axis from +u towards
/// +v.
struct Ellipse {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double a = 0, b = 0, angle = 0;

  Eigen::Vector2d at(double parameter) const;  ///< point at eccentric angle `parameter` [rad]
  /// Symmetric 3x3 conic C with [u v 1] C [u v 1]^T = 0 on the ellipse, negative inside, scaled to |C|_F = 1.
  Eigen::Matrix3d conic() const;
};

/// The ellipse of a conic; `valid` is false when the conic is no real ellipse.
struct EllipseFromConic {
  bool valid = false;
  Ellipse ellipse;
};
EllipseFromConic ellipseFromConic(const Eigen::Matrix3d& conic);

}  // namespace monocular_eye_hand
