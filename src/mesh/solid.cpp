#include "monocular_eye_hand/mesh/solid.h"

#include <fmt/format.h>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <utility>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/topology.h"

namespace monocular_eye_hand {
namespace {

using Geometry = fcl::CollisionGeometry<double>;
using Kind = Solid::Kind;

fcl::Transform3d toFcl(const Rigid3& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = pose.rotation;
  t.translation() = pose.translation;
  return t;
}

std::shared_ptr<const Geometry> meshGeometry(const Mesh& mesh) {
  auto bvh = std::make_shared<fcl::BVHModel<fcl::OBBRSS<double>>>();
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  bvh->beginModel();
  bvh->addSubModel(mesh.vertices, triangles);
  bvh->endModel();
  bvh->computeLocalAABB();
  return bvh;
}

/// Six times the volume that the triangles enclose, below 0 when they face inwards.
double signedVolume(const Mesh& mesh) {
  double sum = 0;
  const Eigen::Vector3d middle = mesh.vertices[size_t(mesh.triangles[0][0])];
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - middle, b = mesh.vertices[t[1]] - middle;
    sum += a.dot(b.cross(mesh.vertices[t[2]] - middle));
  }
  return sum;
}

/// For the question what is inside: a mesh that is inside out is turned.
std::shared_ptr<const RayScene> raysOf(const Mesh& mesh) {
  if (signedVolume(mesh) >= 0) return std::make_shared<RayScene>(mesh);
  Mesh outward = mesh;
  for (auto& t : outward.triangles) std::swap(t[1], t[2]);
  return std::make_shared<RayScene>(outward);
}

bool contains(const Solid& solid, const Rigid3& base_from_solid, const Eigen::Vector3d& p_in_base) {
  if (!solid.rays) return false;
  const Eigen::Vector3d p = base_from_solid.rotation.transpose() * (p_in_base - base_from_solid.translation);
  if (((p - solid.box_centre).cwiseAbs() - solid.half).maxCoeff() > 0) return false;
  return solid.rays->inside(p);
}

bool oneInTheOther(const Solid& a, const Rigid3& base_from_a, const Solid& b, const Rigid3& base_from_b) {
  return contains(b, base_from_b, base_from_a * a.inside) || contains(a, base_from_a, base_from_b * b.inside);
}

double surfaceDistance(const Solid& a, const Rigid3& base_from_a, const Solid& b, const Rigid3& base_from_b) {
  fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  return fcl::distance(a.geometry.get(), toFcl(base_from_a), b.geometry.get(), toFcl(base_from_b), request,
                       result);
}

void requireMesh(const Mesh& mesh) {
  if (mesh.triangles.empty()) throw BadInput("the mesh has no triangles");
  for (const Eigen::Vector3d& p : mesh.vertices)
    if (!p.allFinite()) throw BadInput("the mesh has a vertex that is not finite");
  for (const auto& t : mesh.triangles)
    for (int i : t)
      if (i < 0 || i >= int(mesh.vertices.size()))
        throw BadInput(fmt::format("the mesh has a triangle with vertex {} of {}", i, mesh.vertices.size()));
}

Solid placedSolid(Kind kind, const Rigid3& owner_from_solid) {
  if (!owner_from_solid.isFinite()) throw BadInput("the pose of the shape is not finite");
  Solid solid;
  solid.kind = kind;
  solid.owner_from_solid = owner_from_solid;
  solid.size = solid.half = solid.box_centre = solid.inside = Eigen::Vector3d::Zero();
  return solid;
}

void requireSize(const Eigen::Vector3d& size) {
  if (!size.allFinite() || !(size.minCoeff() > 0))
    throw BadInput("the size of a shape must be above 0 m in every direction");
}

}  // namespace

bool overlap(const OrientedBox& a, const OrientedBox& b) {
  const Eigen::Matrix3d r = a.axes.transpose() * b.axes;
  const Eigen::Vector3d t = a.axes.transpose() * (b.centre - a.centre);
  const Eigen::Matrix3d q = r.cwiseAbs();

  for (int i = 0; i < 3; ++i)
    if (std::abs(t[i]) > a.half[i] + q.row(i).dot(b.half)) return false;
  for (int j = 0; j < 3; ++j)
    if (std::abs(t.dot(r.col(j))) > q.col(j).dot(a.half) + b.half[j]) return false;

  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      // Nearly parallel edges give no axis; the faces have decided then, rounding must not.
      const double reach =
          a.half[i1] * q(i2, j) + a.half[i2] * q(i1, j) + b.half[j1] * q(i, j2) + b.half[j2] * q(i, j1);
      if (std::abs(t[i2] * r(i1, j) - t[i1] * r(i2, j)) > reach + 1e-12) return false;
    }
  }
  return true;
}

OrientedBox Solid::boxAt(const Rigid3& base_from_owner, double padding) const {
  OrientedBox box;
  box.axes.noalias() = base_from_owner.rotation * owner_from_solid.rotation;
  box.centre.noalias() = base_from_owner.rotation * owner_from_solid.translation;
  box.centre += base_from_owner.translation;
  if (kind == Kind::kMesh) box.centre += box.axes * box_centre;
  box.half = half.array() + padding;
  return box;
}

Solid boxSolid(const Eigen::Vector3d& size, const Rigid3& owner_from_solid) {
  Solid solid = placedSolid(Kind::kBox, owner_from_solid);
  requireSize(size);
  solid.size = size;
  solid.half = size / 2;
  solid.geometry = std::make_shared<fcl::Boxd>(size);
  return solid;
}

Solid cylinderSolid(double radius, double length, const Rigid3& owner_from_solid) {
  Solid solid = placedSolid(Kind::kCylinder, owner_from_solid);
  solid.size = {radius, radius, length};
  requireSize(solid.size);
  solid.half = {radius, radius, length / 2};
  solid.geometry = std::make_shared<fcl::Cylinderd>(radius, length);
  return solid;
}

Solid meshSolid(const Mesh& mesh, const Rigid3& owner_from_solid) {
  Solid solid = placedSolid(Kind::kMesh, owner_from_solid);
  requireMesh(mesh);
  Eigen::AlignedBox3d bounds;
  for (const auto& t : mesh.triangles)
    for (int i : t) bounds.extend(mesh.vertices[i]);
  solid.half = bounds.sizes() / 2;
  solid.box_centre = bounds.center();
  solid.inside = mesh.vertices[mesh.triangles[0][0]];
  solid.geometry = meshGeometry(mesh);
  if (isClosed(mesh)) solid.rays = raysOf(mesh);
  return solid;
}

bool touch(const Solid& a, const Rigid3& base_from_a, double padding, const Solid& b,
           const Rigid3& base_from_b) {
  if (a.kind == Kind::kBox && b.kind == Kind::kBox) return true;  // the boxes around them are they
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  const auto collide = [&](const Geometry* geometry) {
    return fcl::collide(geometry, toFcl(base_from_a), b.geometry.get(), toFcl(base_from_b), request, result) >
           0;
  };

  bool hit;
  if (padding > 0 && a.kind == Kind::kBox) {
    const fcl::Boxd bigger(a.size.x() + 2 * padding, a.size.y() + 2 * padding, a.size.z() + 2 * padding);
    hit = collide(&bigger);
  } else if (padding > 0 && a.kind == Kind::kCylinder) {
    const fcl::Cylinderd bigger(a.size.x() + padding, a.size.z() + 2 * padding);
    hit = collide(&bigger);
  } else {
    hit = collide(a.geometry.get());
    if (!hit && padding > 0) hit = surfaceDistance(a, base_from_a, b, base_from_b) < padding;
  }
  return hit || oneInTheOther(a, base_from_a, b, base_from_b);
}

bool surfacesTouch(const Solid& a, const Rigid3& base_from_a, const Solid& b, const Rigid3& base_from_b) {
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(a.geometry.get(), toFcl(base_from_a), b.geometry.get(), toFcl(base_from_b), request,
                      result) > 0;
}

double signedDistance(const Solid& a, const Rigid3& base_from_a, const Solid& b, const Rigid3& base_from_b) {
  fcl::CollisionRequestd request(64, true);
  fcl::CollisionResultd result;
  if (fcl::collide(a.geometry.get(), toFcl(base_from_a), b.geometry.get(), toFcl(base_from_b), request,
                   result) > 0) {
    double depth = 0;
    for (size_t i = 0; i < result.numContacts(); ++i)
      depth = std::max(depth, std::abs(result.getContact(i).penetration_depth));
    return -depth;
  }
  const double distance = surfaceDistance(a, base_from_a, b, base_from_b);
  return oneInTheOther(a, base_from_a, b, base_from_b) ? -std::abs(distance) : distance;
}

}  // namespace monocular_eye_hand
