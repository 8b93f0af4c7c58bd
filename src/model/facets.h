#pragma once
#include <vector>

#include "monocular_eye_hand/mesh/topology.h"

namespace monocular_eye_hand {

/// Where two facets meet along one mesh edge below the sharp angle (or as neighbours in a coarse round wall).
struct FacetLink {
  int facet = -1;  ///< the other facet
  int edge = -1;   ///< Topology::edges
  double angle = 0;
  double width = 0, other_width = 0;  ///< extent of the two facets square to the edge [m]
};

/// A maximal set of coplanar triangles.
struct Facet {
  std::vector<int> triangles;
  std::vector<int> vertices;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double area = 0;
  std::vector<FacetLink> links;
  bool plane = false;  ///< a plane of its own, not a piece of a tessellated curved surface
};

struct Facets {
  std::vector<Facet> facets;
  std::vector<int> facet_of_triangle;
  std::vector<char>
      smooth;  ///< per mesh edge: joins two facets of one curved surface, or a plane tangent to one
};
Facets findFacets(const Mesh& mesh, const Topology& topology, double sharp_angle, double tolerance);

}  // namespace monocular_eye_hand
