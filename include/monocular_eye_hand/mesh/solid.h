#pragma once
#include <memory>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/mesh/mesh.h"
#include "monocular_eye_hand/mesh/ray_scene.h"

namespace fcl {
template <typename S>
class CollisionGeometry;
}

namespace monocular_eye_hand {

/// A box of any orientation.
struct OrientedBox {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< half the edges [m]
};
/// Whether two boxes share a point: 15 separating axes (Gottschalk, Lin, Manocha, SIGGRAPH 1996).
bool overlap(const OrientedBox& a, const OrientedBox& b);

/// A box, a cylinder or a mesh that can be tested against another one, in the frame of its owner.
struct Solid {
  enum class Kind { kBox, kCylinder, kMesh };
  Kind kind = Kind::kBox;
  Rigid3 owner_from_solid;     ///< the box's and cylinder's centre
  Eigen::Vector3d half;        ///< of the box around it, about `box_centre` [m]
  Eigen::Vector3d box_centre;  ///< in the solid's frame
  Eigen::Vector3d size;        ///< box: x, y, z; cylinder: radius, radius, length [m]
  Eigen::Vector3d inside;      ///< a point of it, in its frame
  std::shared_ptr<const fcl::CollisionGeometry<double>> geometry;
  std::shared_ptr<const RayScene> rays;  ///< kMesh: where it has no rim, so that it has an inside

  OrientedBox boxAt(const Rigid3& base_from_owner, double padding) const;
};

// They throw BadInput naming what is wrong with the shape.
Solid boxSolid(const Eigen::Vector3d& size, const Rigid3& owner_from_solid = {});
Solid cylinderSolid(double radius, double length, const Rigid3& owner_from_solid = {});
Solid meshSolid(const Mesh& mesh, const Rigid3& owner_from_solid = {});

/// Whether the solids, the first bigger by `padding`, share a point.
bool touch(const Solid& a, const Rigid3& base_from_a, double padding, const Solid& b,
           const Rigid3& base_from_b);
/// Whether their surfaces meet; what lies wholly inside the other does not touch it so.
bool surfacesTouch(const Solid& a, const Rigid3& base_from_a, const Solid& b, const Rigid3& base_from_b);
/// Between the true shapes, below 0 when they share a point [m].
double signedDistance(const Solid& a, const Rigid3& base_from_a, const Solid& b, const Rigid3& base_from_b);

}  // namespace monocular_eye_hand
