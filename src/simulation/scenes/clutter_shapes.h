#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

// Further closed meshes, to litter a table with. Lengths in metres; all throw BadInput on sizes that make no
// solid.

/// Turned on a lathe about z: `profile` (radius, z) runs counter-clockwise about the solid's section. It
/// begins and ends on the axis (radius 0), or off it: then it closes to a ring.
Mesh turnedMesh(const std::vector<Eigen::Vector2d>& profile, int segments = 48);
/// Base at z = 0, axis z.
Mesh ringMesh(double outer_radius, double inner_radius, double height, int segments = 48);
/// A head and a shank along z, the head's top at z = 0.
Mesh screwMesh(double head_radius, double head_height, double shank_radius, double length);
/// Angle section: legs along +x and +z from the corner at the origin, extruded along y about the middle.
Mesh angleMesh(double leg_x, double leg_z, double thickness, double length);
/// A box without a lid, base at z = 0; `size` outside.
Mesh trayMesh(const Eigen::Vector3d& size, double wall);
/// A round cable along `path` (at least two points).
Mesh cableMesh(const std::vector<Eigen::Vector3d>& path, double radius, int segments = 10);

}  // namespace monocular_eye_hand
