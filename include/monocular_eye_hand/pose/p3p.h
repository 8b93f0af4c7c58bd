#pragma once
#include <Eigen/Core>
#include <array>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

/// Legs of the perspective tetrahedron (Wong et al., eqs. 3-5): distances L1, L2, L3 [m] from the lens centre
/// to three points, one set per real solution with all legs positive.
struct TetrahedronLegs {
  int count = 0;
  std::array<Eigen::Vector3d, 4> legs;
};

/// Solves the perspective tetrahedron. `bearings`: unit directions to the three points as columns (camera
/// frame). `sides`: R23, R13, R12 [m], the distances between the points opposite to 1, 2, 3.
TetrahedronLegs solveTetrahedron(const Eigen::Matrix3d& bearings, const Eigen::Vector3d& sides);

struct PoseSolutions {
  int count = 0;
  std::array<Rigid3, 4> camera_from_object;
};

/// All poses that put three object points (columns, metres) on three bearings (unit columns).
/// Collinear object points give no solution; collinear image points (bearings in one plane: figure 6
/// of Wong et al.) are solved by two of the vectors and their cross product.
PoseSolutions solveP3P(const Eigen::Matrix3d& bearings, const Eigen::Matrix3d& points_in_object);

/// Wong et al., eqs. 6-9: the transform that takes the three camera-frame points (columns) to the
/// object-frame points: `object_from_camera`. Falls back to two vectors and their cross product when the
/// points' matrix is singular.
Rigid3 objectFromCamera(const Eigen::Matrix3d& p_in_object, const Eigen::Matrix3d& p_in_camera);

/// Of the P3P poses, the index of the one that puts `fourth_in_object` nearest the bearing `fourth` [rad,
/// angular error in *error when not null]; -1 when there is no solution.
int chooseByFourthPoint(const PoseSolutions& poses, const Eigen::Vector3d& fourth_in_object,
                        const Eigen::Vector3d& fourth, double* error = nullptr);

}  // namespace monocular_eye_hand
