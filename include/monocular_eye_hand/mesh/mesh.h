#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace monocular_eye_hand {

/// Triangles in metres, in the frame of the file they were read from, which is never moved.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
};

}  // namespace monocular_eye_hand
