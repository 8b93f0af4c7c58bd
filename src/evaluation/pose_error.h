#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/evaluation/dataset.h"

namespace monocular_eye_hand {

/// Identity and discrete symmetries, times the continuous ones in ceil(pi / step) rotations each: the set
/// over which BOP's errors take their minimum. `step` is BOP's max_sym_disc_step, a share of the diameter.
std::vector<Rigid3> discretized(const BopSymmetries& symmetries, double step = 0.01);

/// Maximum symmetry-aware surface distance [m]: min over S of max over x of |P_est x - P_gt S x|
/// (Drost et al. 2017; Hodan et al. 2020, eq. 2). Infinite when a pose is not finite.
double mssd(const Rigid3& estimate, const Rigid3& truth, const std::vector<Eigen::Vector3d>& vertices,
            const std::vector<Rigid3>& symmetries);
/// Maximum symmetry-aware projection distance [px]: the same of the projections (Hodan et al. 2020, eq. 3).
/// Points behind the camera project as the formula says.
double mspd(const Rigid3& estimate, const Rigid3& truth, const Eigen::Matrix3d& intrinsics,
            const std::vector<Eigen::Vector3d>& vertices, const std::vector<Rigid3>& symmetries);

/// Mean distance of the vertices under the estimate to the nearest vertex under the truth [m] (ADI,
/// Hinterstoisser et al. 2012). Small although mssd() is large: an image hardly tells the two poses apart.
/// `most`: at most so many vertices are looked at.
double adi(const Rigid3& estimate, const Rigid3& truth, const std::vector<Eigen::Vector3d>& vertices,
           size_t max_vertices = 300);

/// BOP's ten thresholds of correctness: MSSD as a share of the diameter, MSPD in pixels of a 640 px wide
/// image.
const std::vector<double>& mssdThresholds();
const std::vector<double>& mspdThresholds();

}  // namespace monocular_eye_hand
