#include "simulation/cell/collision.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/mesh/solid.h"
#include "monocular_eye_hand/simulation/cell/gripper.h"

namespace monocular_eye_hand {
namespace {

constexpr double kRounding = 1e-9;  // of boxes around solids that just touch [m]

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

struct Body {
  Body(int owner_, const Mesh& mesh) : owner(owner_), solid(meshSolid(mesh)), vertices(mesh.vertices) {
    place({});
  }
  void place(const Rigid3& pose) {
    world_from_body = pose;
    box = solid.boxAt(pose, kRounding);
  }

  int owner;  // link or object
  Solid solid;
  std::vector<Eigen::Vector3d> vertices;  // own frame
  Rigid3 world_from_body;
  OrientedBox box;
};

bool collide(const Body& a, const Body& b) {
  return overlap(a.box, b.box) && surfacesTouch(a.solid, a.world_from_body, b.solid, b.world_from_body);
}

double lowestOf(const Body& body) {
  double z = 1e9;
  for (const Eigen::Vector3d& p : body.vertices) z = std::min(z, (body.world_from_body * p).z());
  return z;
}

}  // namespace

struct CellSolids::Impl {
  std::vector<Body> links, objects;
  std::vector<Body> table;   // one or none
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
      impl_->links.emplace_back(int(k), solidMesh(shrunk(shape, tolerance)));
  }

  for (size_t k = 0; k < objects.size(); ++k) {
    impl_->objects.emplace_back(int(k), *objects[k].mesh);
    impl_->objects.back().place(objects[k].world_from_object);
  }

  if (!table.present) return;
  impl_->table.emplace_back(0, boxMesh({2 * table.half_width, 2 * table.half_depth, table_thickness}));
  impl_->table[0].place({Eigen::Matrix3d::Identity(), {0, 0, -table_thickness}});
}

CellSolids::~CellSolids() = default;

void CellSolids::placeArm(const std::vector<Rigid3>& world_from_links) {
  for (Body& body : impl_->links) body.place(world_from_links[size_t(body.owner)]);
}

void CellSolids::placeObject(int object, const Rigid3& world_from_object) {
  impl_->objects[size_t(object)].place(world_from_object);
}

std::vector<std::pair<int, int>> CellSolids::armCollisions(int carried) const {
  std::vector<std::pair<int, int>> pairs;
  for (const Body& link : impl_->links) {
    for (const Body& table : impl_->table)
      if (collide(link, table)) pairs.emplace_back(link.owner, kTable);
    if (impl_->moves[size_t(link.owner)] && lowestOf(link) < impl_->floor_z)
      pairs.emplace_back(link.owner, kFloor);
    for (const Body& object : impl_->objects)
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
  const Body& own = impl_->objects[size_t(object)];
  const Rigid3 lifted{own.world_from_body.rotation,
                      own.world_from_body.translation + Eigen::Vector3d(0, 0, impl_->tolerance)};
  const OrientedBox lifted_box = own.solid.boxAt(lifted, kRounding);
  for (const Body& table : impl_->table)
    if (overlap(lifted_box, table.box) &&
        surfacesTouch(own.solid, lifted, table.solid, table.world_from_body))
      out.push_back(kTable);
  if (lowestOf(own) < impl_->floor_z - impl_->tolerance) out.push_back(kFloor);
  for (const Body& other : impl_->objects)
    if (other.owner != object && collide(own, other)) out.push_back(other.owner);
  return out;
}

bool CellSolids::meet(int a, int b) const {
  return collide(impl_->objects[size_t(a)], impl_->objects[size_t(b)]);
}

}  // namespace monocular_eye_hand
