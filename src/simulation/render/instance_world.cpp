#include "simulation/render/instance_world.h"

#include <Eigen/Geometry>
#include <memory>

#include "simulation/render/corner_normals.h"

namespace monocular_eye_hand {

InstanceWorld::InstanceWorld(const std::vector<const Mesh*>& meshes) {
  for (const Mesh* mesh : meshes) {
    const auto body = std::make_shared<RayTracer>();
    body->add(*mesh);
    body->commit();
    all_.add(body);
    seen_.add(body);
    corner_normals_.push_back(cornerNormals(*mesh, Eigen::Matrix3d::Identity()));
  }
  rotations_.assign(meshes.size(), Eigen::Matrix3f::Identity());
}

void InstanceWorld::place(const std::vector<Rigid3>& world_from_body, const std::vector<bool>& seen) {
  for (size_t k = 0; k < rotations_.size(); ++k) {
    rotations_[k] = world_from_body[k].rotation.cast<float>();
    all_.place(int(k), world_from_body[k]);
    seen_.place(int(k), world_from_body[k]);
    seen_.show(int(k), seen[k]);
  }
  all_.commit();
  seen_.commit();
}

void InstanceWorld::cast(const Rays& rays, float near, Hits* hits) const {
  seen_.cast(rays, near, hits);
  for (int k = 0; k < kLanes; ++k) {
    if (hits->id[k] == RayTracer::kNone) continue;
    const Eigen::Vector3f direction(rays.dx[k], rays.dy[k], rays.dz[k]);
    hits->normal[k] = facingNormal(rotations_[size_t(hits->id[k])] * hits->normal[k], direction);
  }
}

Eigen::Vector3f InstanceWorld::smoothNormal(int body, unsigned triangle, float u, float v,
                                            const Eigen::Vector3f& geometric) const {
  const Eigen::Vector3f* corner = &corner_normals_[size_t(body)][3 * triangle];
  const Eigen::Vector3f n =
      rotations_[size_t(body)] * ((1 - u - v) * corner[0] + u * corner[1] + v * corner[2]).normalized();
  return n.dot(geometric) < 0 ? Eigen::Vector3f(-n) : n;
}

}  // namespace monocular_eye_hand
