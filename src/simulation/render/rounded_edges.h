#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// Lets the shading of sharp edges turn over a small radius, as real edges do. The triangles stay.
class RoundedEdges {
 public:
  RoundedEdges() = default;
  RoundedEdges(const Mesh& mesh, const Rigid3& world_from_mesh, double radius);  // radius [m]

  struct Bend {
    bool bent = false;
    Eigen::Vector3f normal;  ///< unit
    Eigen::Vector3f origin;  ///< where rays to the lights start: outside, on the edge
  };
  /// At point p of the triangle (world frame), whose normal would be `normal`.
  Bend bend(uint32_t triangle, const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const;

  /// 1 on a convex sharp edge, falling to 0 at `width` from it [m].
  float nearness(uint32_t triangle, const Eigen::Vector3f& p, float width) const;

 private:
  struct Edge {
    Eigen::Vector3f p, along;  // along: unit
    float length;
    Eigen::Vector3f middle;  // unit normal half way round
    float width;             // the rounding begins so far from the edge
    bool convex;
  };
  Eigen::Vector3f closestPoint(const Edge& edge, const Eigen::Vector3f& p) const;

  std::vector<Edge> edges_;
  std::vector<int> first_;  // of each triangle in near_, and one past the last
  std::vector<int> near_;   // edges_ near each triangle
};

}  // namespace monocular_eye_hand
