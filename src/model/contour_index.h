#pragma once
#include <vector>

#include "monocular_eye_hand/mesh/topology.h"
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// A piece [low, high] of a generator line [m along the axis].
struct HeightRange {
  double low, high;
};

/// The wall of a convex fitted cylinder, unrolled: which heights exist at which angle.
struct CylinderWall {
  int feature = 0;
  Eigen::Vector3d point, axis, x, y;
  double radius = 0, start = 0;  ///< start: how far outside the wall visibility rays begin [m]
  struct Triangle {
    double angle[3];  ///< angle[0] in (-pi, pi], the others within pi of it
    double height[3];
    double low, high;  ///< range of the angles
  };
  std::vector<Triangle> triangles;

  /// Heights that the wall covers at `angle`, joined and ascending.
  void cover(double angle, std::vector<HeightRange>* out) const;
};

/// A free-form surface with normals at its vertices: its silhouette runs where normal . view ray crosses
/// zero. Where it comes to a point, as at the tip of a cone, every edge that ends there has a normal of its
/// own.
struct FreeformPatch {
  int feature = 0;
  double start = 0;
  std::vector<Eigen::Vector3d> points, normals;  ///< per node: a vertex, or an edge's end at a point
  struct Triangle {
    int begin[3], end[3];  ///< nodes of the edges; end[k] and begin[k + 1] differ only at a point
    int edge[3];           ///< local numbers of the edges
  };
  std::vector<Triangle> triangles;
  int edge_count = 0;
};

/// What visibleContour prepares once per model.
class ContourIndex {
 public:
  ContourIndex(const ObjectModel& model, const Topology& topology, const std::vector<char>& sharp);
  std::vector<CylinderWall> walls;
  std::vector<FreeformPatch> patches;
  double start = 0;  ///< how far outside the surface visibility rays of sharp features begin [m]

 private:
  void addWall(const ObjectModel& model, int surface);
  void addPatch(const ObjectModel& model, const Topology& topology, const std::vector<char>& sharp,
                int surface);
};

/// Vertices of a smooth line, walked at a fixed step.
struct Polyline {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;
};

/// Silhouette lines of a free-form patch seen from `eye`.
std::vector<Polyline> silhouetteLines(const FreeformPatch& patch, const Eigen::Vector3d& eye);

}  // namespace monocular_eye_hand
