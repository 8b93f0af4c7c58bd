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
  Eigen::Vector2d uv;  ///< rectified pixel
  double sigma = 1.0;  ///< standard deviation per axis [px]
};

struct RefineOptions {
  int max_iterations = 15;
  double robust_scale = 3.0;  ///< Tukey cut-off in standard deviations; 0 = least squares
  double min_step = 1e-7;     ///< stop when the step is smaller [m, rad]

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("max_iterations", max_iterations);
    v("robust_scale", robust_scale);
    v("min_step", min_step);
  }
};

struct RefinedPose {
  Rigid3 camera_from_object;
  /// See perturbed(); scaled by the residuals' robust variance (by 1 when there is no redundancy). Directions
  /// that the matches leave open have the variance of a weak prior, 1 m and pi / sqrt(3) rad.
  Matrix6d covariance = Matrix6d::Zero();
  double rms = 0;      ///< weighted rms residual [px]
  double inliers = 0;  ///< sum of robust weights, one per match
  int iterations = 0;
  bool converged = false;
  bool well_posed = false;  ///< the normal equations have full rank (or full rank but for `free_axis`)
};

/// A rotation about `direction` (object frame) through `point` that cannot be seen.
struct FreeAxis {
  bool present = false;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), direction = Eigen::Vector3d::UnitZ();
};

/// Levenberg-Marquardt on the pose with analytic Jacobians, d pi/dP [I, -skew(R p)] for perturbed()'s
/// motions, and Tukey's weights at robust_scale standard deviations; while the residuals are larger than
/// their sigmas say (a coarse start), a standard deviation is the residuals' own (1.48 x median). A rotation
/// about `free_axis` is held, and its variance set to pi^2/3. Points behind the camera count as outliers.
/// `start` comes back, `converged` false, when a number is not finite, a sigma not positive, or no match
/// usable. Throws BadInput when an option is out of range.
RefinedPose refinePose(const Rigid3& start, const Camera& camera, const std::vector<LineMatch>& lines,
                       const std::vector<PointMatch>& points, const RefineOptions& options = {},
                       const FreeAxis& free_axis = {});

/// Residual [px] of a line match and its derivative by perturbed()'s d, where the point is before the camera
/// (z > 0).
double lineResidual(const Rigid3& camera_from_object, const Camera& camera, const LineMatch& match,
                    Vector6d* derivative = nullptr);
/// Residuals [px] of a point match and their derivatives (rows).
Eigen::Vector2d pointResidual(const Rigid3& camera_from_object, const Camera& camera, const PointMatch& match,
                              Eigen::Matrix<double, 2, 6>* derivative = nullptr);

/// Seed 2.4: of all matched points, the four with the least uncertainty and the widest spread: those whose
/// pose has the smallest covariance (determinant), a point's variance being sigma^2 + its squared residual
/// under `start`. Indices into `points`, ascending; empty when fewer than four are usable or no four fix a
/// pose.
std::vector<int> bestFour(const std::vector<PointMatch>& points, const Rigid3& start, const Camera& camera);

/// The pose re-calculated from the best four: the perspective tetrahedron of each three of them with the
/// fourth point to choose, and `start`; the one that fits the four best is refined on them. `converged` is
/// false, and the pose `start`, when there are no best four.
RefinedPose poseFromBestFour(const std::vector<PointMatch>& points, const Rigid3& start,
                             const Camera& camera);

}  // namespace monocular_eye_hand
