#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/view.h"

namespace monocular_eye_hand {

/// image_from_plane of a view of a flat target (z = 0) through an ideal lens, by the direct linear
/// transformation with normalised coordinates (Hartley and Zisserman 2004, algorithm 4.2). Nothing of fewer
/// than four points, of points on a line, and of a target that is not flat.
std::optional<Eigen::Matrix3d> homographyOf(const CalibrationView& view);

/// Focal lengths (fx, fy) [px] of a camera with this principal point that saw a plane so: each view's plane
/// has two axes of one length at a right angle (Zhang 2000, equations 3 and 4). Nothing when no view is
/// tilted enough to tell.
std::optional<Eigen::Vector2d> focalLengths(const std::vector<Eigen::Matrix3d>& image_from_plane,
                                            const Eigen::Vector2d& principal_point);

}  // namespace monocular_eye_hand
