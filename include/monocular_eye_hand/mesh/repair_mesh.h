#pragma once
#include <string>

#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

/// What welding and repair found and did.
struct RepairedMesh {
  Mesh mesh;
  double tolerance = 0;     ///< distance below which two points are one [m]
  int degenerate = 0;       ///< triangles without area, dropped
  int turned = 0;           ///< triangles whose corner order disagreed with their neighbours'
  int rim_edges = 0;        ///< edges with one triangle
  int crowded_edges = 0;    ///< edges with more than two triangles
  bool inside_out = false;  ///< the whole mesh was turned
  bool closed = false;
};

/// Welds vertices nearer than `weld_share` of the diameter, drops triangles without area, closes T-junctions,
/// and makes the corner order of the triangles agree, outward where the mesh is closed. `name` is for
/// messages.
RepairedMesh repairMesh(const std::string& name, const Mesh& mesh, double weld_share);

}  // namespace monocular_eye_hand
