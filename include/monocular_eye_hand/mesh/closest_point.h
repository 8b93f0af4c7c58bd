#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

/// Distance from points to the surface of a mesh, by a tree of boxes.
class ClosestPoint {
 public:
  explicit ClosestPoint(const Mesh& mesh);
  /// Distance to the nearest triangle, or `limit` when none is nearer [m].
  double distance(const Eigen::Vector3d& p, double limit) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int left = -1, right = -1;  // children; a leaf has left = -1
    int begin = 0, end = 0;     // leaf: range of order_
  };
  int build(int begin, int end, const std::vector<Eigen::AlignedBox3d>& boxes);
  const Mesh& mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

/// Squared distance from a point to a triangle.
double squaredDistanceToTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& c);

}  // namespace monocular_eye_hand
