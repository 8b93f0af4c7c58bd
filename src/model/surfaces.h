#pragma once
#include <vector>

#include "monocular_eye_hand/mesh/topology.h"
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// Surfaces of a mesh and which of its edges are sharp.
struct SurfaceSplit {
  std::vector<Surface> surfaces;
  std::vector<int> surface_of_triangle;
  std::vector<char> sharp;        ///< per mesh edge: crease or rim
  double tessellation_error = 0;  ///< how far the triangles stay from the true curved surfaces, about [m]
};

/// Merges coplanar triangles into facets, tells true planes from the facets of a tessellated curved surface,
/// fits cylinders to chains of facets, and grows what is left into free-form surfaces.
///
/// Facets that meet below `sharp_angle` are one smooth surface. A coarse wall (12 to 17 segments around, 30
/// to 20 degrees apart) is smooth too when at least three neighbouring facets of equal width turn by equal
/// angles; a hexagonal or octagonal prism keeps its edges.
SurfaceSplit splitSurfaces(const Mesh& mesh, const Topology& topology, double sharp_angle, double tolerance);

/// A mesh edge where two surfaces meet smoothly.
struct SmoothBorder {
  int a, b;  ///< SurfaceSplit::surfaces
  const MeshEdge* edge;
};
std::vector<SmoothBorder> smoothBorders(const Topology& topology, const SurfaceSplit& split);

/// A cylinder through points with given outward normals.
struct CylinderFit {
  bool valid = false;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::UnitZ();
  double radius = 0;
  double residual = 0;  ///< largest distance of a point from the cylinder [m]
};
CylinderFit fitCylinder(const std::vector<Eigen::Vector3d>& points,
                        const std::vector<Eigen::Vector3d>& normals, const std::vector<double>& weights);

/// A circle through points in space: plane by principal axes, circle by algebraic least squares.
struct CircleFit {
  bool valid = false;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::UnitZ();
  double radius = 0;
  double residual = 0;  ///< largest distance of a point from the circle [m]
};
CircleFit fitCircle(const std::vector<Eigen::Vector3d>& points);

}  // namespace monocular_eye_hand
