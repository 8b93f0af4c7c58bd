#include "simulation/cell_collision.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/simulation/cell_gripper.h"

namespace monocular_eye_hand {
namespace {

using Geometry = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Geometry> geometryOf(const Mesh& mesh) {
  auto out = std::make_shared<Geometry>();
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) triangles.emplace_back(size_t(t[0]), size_t(t[1]), size_t(t[2]));
  out->beginModel(int(triangles.size()), int(mesh.vertices.size()));
  out->addSubModel(mesh.vertices, triangles);
  out->endModel();
  out->computeLocalAABB();
  return out;
}

fcl::Transform3d isometry(const Rigid3& a_from_b) {
  fcl::Transform3d out = fcl::Transform3d::Identity();
  out.linear() = a_from_b.rotation;
  out.translation() = a_from_b.translation;
  return out;
}

/// A solid with every side `by` further in (convex meshes: their vertices that much nearer to the middle).
ArmShape shrunk(ArmShape shape, double by) {
  if (shape.kind != ArmShape::Kind::kMesh) {
    const Eigen::Vector3d less = shape.kind == ArmShape::Kind::kBox ? Eigen::Vector3d::Constant(2 * by)
                                                                    : Eigen::Vector3d(by, by, 2 * by);
    shape.size = (shape.size - less).cwiseMax(1e-4);
    return shape;
  }
  auto mesh = std::make_shared<Mesh>(*shape.mesh);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : mesh->vertices) middle += p / double(mesh->vertices.size());
  for (Eigen::Vector3d& p : mesh->vertices) {
    const Eigen::Vector3d d = p - middle;
    p = middle + d * std::max(0.0, 1 - by / std::max(d.norm(), 1e-9));
  }
  shape.mesh = mesh;
  return shape;
}

struct Solid {
  int owner;  // link or object
  std::unique_ptr<fcl::CollisionObjectd> body;
  std::vector<Eigen::Vector3d> vertices;  // own frame
  void place(const Rigid3& world_from_owner) {
    body->setTransform(isometry(world_from_owner));
    body->computeAABB();
  }
};

Solid makeSolid(int owner, const Mesh& mesh) {
  return {owner, std::make_unique<fcl::CollisionObjectd>(geometryOf(mesh)), mesh.vertices};
}

bool collide(const Solid& a, const Solid& b) {
  if (!a.body->getAABB().overlap(b.body->getAABB())) return false;
  fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(a.body.get(), b.body.get(), request, result) > 0;
}

double lowestOf(const Solid& solid) {
  double z = 1e9;
  for (const Eigen::Vector3d& p : solid.vertices) z = std::min(z, (solid.body->getTransform() * p).z());
  return z;
}

}  // namespace

struct CellSolids::Impl {
  std::vector<Solid> links, objects;
  std::vector<Solid> table;  // one or none
  std::vector<bool> finger;  // per link
  std::vector<bool> moves;   // per link: some joint turns it
  double floor_z = 0, tolerance = 0;
};

CellSolids::CellSolids(const ArmDescription& arm, const std::vector<SceneObject>& objects,
                       double table_thickness, const Table& table, double floor_z, double tolerance)
    : impl_(new Impl) {
  impl_->floor_z = floor_z;
  impl_->tolerance = tolerance;

  for (size_t k = 0; k < arm.links.size(); ++k) {
    const ArmLink& link = arm.links[k];
    impl_->finger.push_back(link.finger != 0);
    impl_->moves.push_back(link.joint >= 0 || (link.parent >= 0 && impl_->moves[size_t(link.parent)]));
    for (const ArmShape& shape : link.collision)
      impl_->links.push_back(makeSolid(int(k), solidMesh(shrunk(shape, tolerance))));
  }

  for (size_t k = 0; k < objects.size(); ++k) {
    impl_->objects.push_back(makeSolid(int(k), *objects[k].mesh));
    impl_->objects.back().place(objects[k].world_from_object);
  }

  if (!table.present) return;
  impl_->table.push_back(
      makeSolid(0, boxMesh({2 * table.half_width, 2 * table.half_depth, table_thickness})));
  impl_->table[0].place({Eigen::Matrix3d::Identity(), {0, 0, -table_thickness}});
}

CellSolids::~CellSolids() = default;

void CellSolids::placeArm(const std::vector<Rigid3>& world_from_links) {
  for (Solid& solid : impl_->links) solid.place(world_from_links[size_t(solid.owner)]);
}

void CellSolids::placeObject(int object, const Rigid3& world_from_object) {
  impl_->objects[size_t(object)].place(world_from_object);
}

std::vector<std::pair<int, int>> CellSolids::armCollisions(int carried) const {
  std::vector<std::pair<int, int>> pairs;
  for (const Solid& link : impl_->links) {
    for (const Solid& table : impl_->table)
      if (collide(link, table)) pairs.emplace_back(link.owner, kTable);
    if (impl_->moves[size_t(link.owner)] && lowestOf(link) < impl_->floor_z)
      pairs.emplace_back(link.owner, kFloor);
    for (const Solid& object : impl_->objects)
      if (!(object.owner == carried && impl_->finger[size_t(link.owner)]) && collide(link, object))
        pairs.emplace_back(link.owner, object.owner);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::vector<int> CellSolids::objectCollisions(int object) const {
  std::vector<int> out;
  // Resting on the table or set down on it is no collision: a copy that hangs `tolerance` higher is asked.
  const Solid& own = impl_->objects[size_t(object)];
  fcl::CollisionObjectd lifted(*own.body);
  lifted.setTranslation(own.body->getTranslation() + Eigen::Vector3d(0, 0, impl_->tolerance));
  lifted.computeAABB();
  for (const Solid& table : impl_->table) {
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    if (lifted.getAABB().overlap(table.body->getAABB()) &&
        fcl::collide(&lifted, table.body.get(), request, result) > 0)
      out.push_back(kTable);
  }
  if (lowestOf(own) < impl_->floor_z - impl_->tolerance) out.push_back(kFloor);
  for (const Solid& other : impl_->objects)
    if (other.owner != object && collide(own, other)) out.push_back(other.owner);
  return out;
}

bool CellSolids::meet(int a, int b) const {
  return collide(impl_->objects[size_t(a)], impl_->objects[size_t(b)]);
}

}  // namespace monocular_eye_hand
