#include "simulation/render/ray_world.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <limits>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/render/rendered_image.h"
#include "simulation/render/corner_normals.h"

namespace monocular_eye_hand {
namespace {

void checkMesh(const std::string& name, const Mesh* mesh) {
  if (!mesh || mesh->triangles.empty())
    throw BadInput("scene: object '" + name + "' has no triangles; load or build its mesh first");
  for (const auto& triangle : mesh->triangles)
    for (int v : triangle)
      if (v < 0 || v >= int(mesh->vertices.size()))
        throw BadInput(fmt::format("scene: object '{}' has a triangle with vertex {} of {}", name, v,
                                   mesh->vertices.size()));
}

}  // namespace

RayWorld::RayWorld(const Scene& scene) {
  for (const SceneObject& object : scene.objects) {
    checkMesh(object.name, object.mesh.get());
    if (!object.world_from_object.isFinite())
      throw BadInput("scene: the pose of object '" + object.name + "' is not finite");
  }

  for (const SceneObject& object : scene.objects) {
    add(*object.mesh, object.world_from_object);
    alone_.push_back(std::make_unique<RayTracer>());
    alone_.back()->add(*object.mesh, object.world_from_object);
    alone_.back()->commit();
  }

  if (scene.table.present) add(quadMesh(2 * scene.table.half_width, 2 * scene.table.half_depth), Rigid3{});
  world_.commit();
}

void RayWorld::add(const Mesh& mesh, const Rigid3& world_from_mesh) {
  world_.add(mesh, world_from_mesh);
  corner_normals_.push_back(cornerNormals(mesh, world_from_mesh.rotation));
}

RayWorld::Hit RayWorld::cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  const RayTracer::Hit hit = world_.cast(origin, direction);
  if (hit.id == RayTracer::kNone) return {kNothingId, 0, 0, 0, 0, Eigen::Vector3f::Zero()};
  const int id = hit.id < int(alone_.size()) ? hit.id : kTableId;
  return {id, hit.distance, hit.triangle, hit.u, hit.v, facingNormal(hit.normal, direction)};
}

bool RayWorld::meets(int object, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  return alone_[size_t(object)]->blocked(origin, direction, std::numeric_limits<float>::infinity());
}

Eigen::Vector3f RayWorld::smoothNormal(const Hit& hit) const {
  if (hit.id == kTableId) return hit.normal;
  const Eigen::Vector3f* corner = &corner_normals_[hit.id][3 * hit.triangle];
  const Eigen::Vector3f n =
      ((1 - hit.u - hit.v) * corner[0] + hit.u * corner[1] + hit.v * corner[2]).normalized();
  return n.dot(hit.normal) < 0 ? Eigen::Vector3f(-n) : n;
}

}  // namespace monocular_eye_hand
