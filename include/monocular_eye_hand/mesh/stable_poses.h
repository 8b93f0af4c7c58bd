#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

/// A way to rest on the table.
struct StablePose {
  Rigid3 table_from_object;  ///< lowest points at z = 0, centre of mass above the origin
  double weight = 0;         ///< how far it is from toppling, the sum over a mesh's poses is 1
};

/// Faces of the convex hull that carry the centre of mass, most stable first.
/// Throws BadInput when the mesh is empty or flat.
std::vector<StablePose> stablePoses(const Mesh& mesh);

/// Of the solid a closed mesh bounds; the middle of its vertices when it bounds none. Object frame [m].
/// Throws BadInput when the mesh is empty.
Eigen::Vector3d centreOfMass(const Mesh& mesh);

}  // namespace monocular_eye_hand
