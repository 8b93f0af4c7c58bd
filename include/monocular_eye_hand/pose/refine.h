#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// An object point that is seen somewhere on an image line: residual = normal . (project(p) - uv).
struct LineMatch {
  Eigen::Vector3d p_in_object;
  Eigen::Vector2d uv;      ///< rectified pixel on the line
  Eigen::Vector2d normal;  ///< unit
  double sigma = 1.0;      ///< standard deviation along the normal [px]
};

/// An object point seen at a pixel (two residuals).
struct PointMatch {
  Eigen::Vector3d p_in_object;
  Eigen::Vector2d uv;
  double sigma = 1.0;  ///< [px]
};

struct RefineOptions {
  int max_iterations = 10;
  double robust_scale = 3.0;  ///< Tukey cut-off in standard deviations; 0 = least squares
  double min_step = 1e-7;     ///< stop when the step is smaller [m, rad]
};

struct RefinedPose {
  Rigid3 camera_from_object;
  Matrix6d covariance = Matrix6d::Zero();  ///< see perturbed(); scaled by the residuals' robust variance
  double rms = 0;      ///< weighted rms residual [px]
  double inliers = 0;  ///< sum of robust weights
  int iterations = 0;
  bool converged = false;
  bool well_posed = false;  ///< the normal equations have full rank (or full rank but for `free_axis`)
};

/// Levenberg-Marquardt on SE(3), analytic Jacobians (facts: J = d pi/dP [I, -skew(R x)]), Tukey weights.
/// A rotation about `free_axis` (object frame direction through `free_point`), when given, is held: it cannot be
/// seen, and its covariance is set to pi^2/3.
struct FreeAxis {
  bool present = false;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), direction = Eigen::Vector3d::UnitZ();
};
RefinedPose refinePose(const Rigid3& start, const Camera& camera, const std::vector<LineMatch>& lines,
                       const std::vector<PointMatch>& points, const RefineOptions& options = {},
                       const FreeAxis& free_axis = {});

/// Seed 2.4: of all matched points, the four with the least uncertainty and the widest spread, and the pose
/// re-calculated from them. Indices into `points`; empty when fewer than four or degenerate.
std::vector<int> bestFour(const std::vector<PointMatch>& points, const Rigid3& start, const Camera& camera);
RefinedPose poseFromBestFour(const std::vector<PointMatch>& points, const Rigid3& start, const Camera& camera);

}  // namespace monocular_eye_hand
