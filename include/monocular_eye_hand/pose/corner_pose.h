#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// A corner triplet of lines: the corner's bearing and the images of three edges that meet there (camera
/// frame).
struct CornerObservation {
  Eigen::Vector3d corner;  ///< unit bearing of the corner
  Eigen::Matrix3d
      far_points;  ///< columns: a bearing (unit) on each of the three image lines, away from the corner
};

/// Rotations `camera_from_object` that take the three edge directions (unit columns, object frame, pointing
/// away from the corner) into the three interpretation planes, each on the observed side of the corner. Up to
/// four. With theta the angle of edge 1 to the line of sight, the two conditions on the other edges leave a
/// quartic in cos theta (compare Dhome et al., IEEE PAMI 11(12), 1989); its roots are polished on all three
/// edges. Empty when edges or image lines coincide or a number is not finite. One known length (corner to far
/// end of an edge) then fixes the translation: see cornerDepth().
std::vector<Eigen::Matrix3d> cornerRotations(const CornerObservation& seen,
                                             const Eigen::Matrix3d& directions_in_object);

/// Distance [m] of the corner along its bearing when the end of an edge of `length` [m] along
/// `edge_in_camera` (unit) is seen at the bearing `end` (unit). 0 when the edge lies in the line of sight or
/// the end on its wrong side.
double cornerDepth(const Eigen::Vector3d& corner, const Eigen::Vector3d& end,
                   const Eigen::Vector3d& edge_in_camera, double length);

}  // namespace monocular_eye_hand
