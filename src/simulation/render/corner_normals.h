#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

/// Three normals per triangle, unit, `rotation` applied: averaged over the triangles around a corner that
/// meet below 20 degrees, so that tessellated cylinders look round.
std::vector<Eigen::Vector3f> cornerNormals(const Mesh& mesh, const Eigen::Matrix3d& rotation);

}  // namespace monocular_eye_hand
