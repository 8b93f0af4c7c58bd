#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// Pose candidates from a corner triplet of lines: the corner's bearing, the images of three edges that meet there
/// and one known length (the corner's depth follows from it).
struct CornerObservation {
  Eigen::Vector3d corner;                 ///< unit bearing of the corner
  Eigen::Matrix3d far_points;             ///< columns: a bearing (unit) on each of the three image lines, away from the corner
};

/// Rotations that take the three edge directions (unit columns, object frame, pointing away from the corner) into
/// the three interpretation planes, each on the observed side. Up to four.
std::vector<Eigen::Matrix3d> cornerRotations(const CornerObservation& seen,
                                             const Eigen::Matrix3d& directions_in_object);

}  // namespace monocular_eye_hand
