#pragma once
#include <memory>
#include <vector>

#include "monocular_eye_hand/arm/arm_description.h"

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

/// One shape that can be tested against another, in the frame of its owner.
struct Solid {
  ArmShape::Kind kind = ArmShape::Kind::kBox;
  Rigid3 owner_from_solid;           ///< the box's and cylinder's centre
  Eigen::Vector3d half;              ///< of the box around it, about `box_centre`
  Eigen::Vector3d box_centre;        ///< in the solid's frame
  Eigen::Vector3d size;              ///< as ArmShape
  std::shared_ptr<const Mesh> mesh;  ///< kMesh
  bool closed = false;               ///< kMesh: no rim, so it has an inside
  Eigen::Vector3d inside;            ///< a point of it, in its frame
  std::shared_ptr<const fcl::CollisionGeometry<double>> geometry;

  OrientedBox boxAt(const Rigid3& base_from_owner, double padding) const;
};

/// Throws BadInput naming what is wrong with the shape.
Solid makeSolid(const ArmShape& shape);

/// Whether the solids, the first bigger by `padding`, share a point.
bool touch(const Solid& a, const Rigid3& base_from_a, double padding, const Solid& b,
           const Rigid3& base_from_b);
/// Between the true shapes, below 0 when they share a point [m].
double signedDistance(const Solid& a, const Rigid3& base_from_a, const Solid& b, const Rigid3& base_from_b);

}  // namespace monocular_eye_hand
