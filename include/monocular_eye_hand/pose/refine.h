#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/pose/matches.h"

namespace monocular_eye_hand {

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

/// Wong et al. 2.4: of all matched points, the four with the least uncertainty and the widest spread: those
/// whose pose has the smallest covariance (determinant), a point's variance being sigma^2 + its squared
/// residual under `start`. Indices into `points`, ascending; empty when fewer than four are usable or no four
/// fix a pose.
std::vector<int> bestFour(const std::vector<PointMatch>& points, const Rigid3& start, const Camera& camera);

/// The pose re-calculated from the best four: the perspective tetrahedron of each three of them with the
/// fourth point to choose, and `start`; the one that fits the four best is refined on them. `converged` is
/// false, and the pose `start`, when there are no best four.
RefinedPose poseFromBestFour(const std::vector<PointMatch>& points, const Rigid3& start,
                             const Camera& camera);

}  // namespace monocular_eye_hand
