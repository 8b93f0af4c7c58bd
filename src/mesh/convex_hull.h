#pragma once
#include <Eigen/Core>
#include <vector>

namespace monocular_eye_hand {

/// Outward unit normals of the faces of the convex hull of points in general position (incremental
/// construction, O(points x faces)). Empty when all points lie in a plane.
std::vector<Eigen::Vector3d> hullNormals(const std::vector<Eigen::Vector3d>& points);

/// Convex hull in the plane, counter-clockwise, without collinear points (Andrew's monotone chain).
std::vector<Eigen::Vector2d> planarHull(std::vector<Eigen::Vector2d> points);

}  // namespace monocular_eye_hand
