#include "simulation/ray_world.h"

#include <Eigen/Geometry>
#include <limits>
#include <stdexcept>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/rendered_image.h"
#include "simulation/corner_normals.h"

namespace monocular_eye_hand {
namespace {

void checkMesh(const std::string& name, const Mesh* mesh) {
  if (!mesh || mesh->triangles.empty())
    throw BadInput("scene: object '" + name + "' has no triangles; load or build its mesh first");
  for (const auto& triangle : mesh->triangles)
    for (int v : triangle)
      if (v < 0 || v >= int(mesh->vertices.size()))
        throw BadInput("scene: object '" + name + "' has a triangle with vertex " + std::to_string(v) +
                       " of " + std::to_string(mesh->vertices.size()));
}

RTCRayHit makeRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
  RTCRayHit ray;
  ray.ray.org_x = origin.x();
  ray.ray.org_y = origin.y();
  ray.ray.org_z = origin.z();
  ray.ray.dir_x = direction.x();
  ray.ray.dir_y = direction.y();
  ray.ray.dir_z = direction.z();
  ray.ray.tnear = 0;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.time = 0;
  ray.ray.mask = ~0u;
  ray.ray.id = 0;
  ray.ray.flags = 0;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

}  // namespace

RayWorld::RayWorld(const Scene& scene) {
  for (const SceneObject& object : scene.objects) {
    checkMesh(object.name, object.mesh.get());
    if (!object.world_from_object.isFinite())
      throw BadInput("scene: the pose of object '" + object.name + "' is not finite");
  }

  device_ = rtcNewDevice("threads=1,set_affinity=0");
  if (!device_) throw std::runtime_error("Embree gave no device");
  world_ = rtcNewScene(device_);

  for (const SceneObject& object : scene.objects) {
    RTCGeometry geometry = addMesh(*object.mesh, object.world_from_object);
    RTCScene alone = rtcNewScene(device_);
    rtcAttachGeometry(alone, geometry);
    rtcCommitScene(alone);
    alone_.push_back(alone);
    rtcReleaseGeometry(geometry);
  }

  if (scene.table.present)
    rtcReleaseGeometry(addMesh(quadMesh(2 * scene.table.half_width, 2 * scene.table.half_depth), Rigid3{}));
  rtcCommitScene(world_);
}

RayWorld::~RayWorld() {
  for (RTCScene scene : alone_) rtcReleaseScene(scene);
  rtcReleaseScene(world_);
  rtcReleaseDevice(device_);
}

RTCGeometry RayWorld::addMesh(const Mesh& mesh, const Rigid3& world_from_mesh) {
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  for (const Eigen::Vector3d& p : mesh.vertices) {
    const Eigen::Vector3d q = world_from_mesh * p;
    for (int k = 0; k < 3; ++k) *vertices++ = float(q[k]);
  }
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles)
    for (int v : triangle) *indices++ = unsigned(v);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(world_, geometry);  // ids count up from 0 in the order of attaching
  corner_normals_.push_back(cornerNormals(mesh, world_from_mesh.rotation));
  return geometry;
}

RayWorld::Hit RayWorld::cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  RTCRayHit ray = makeRay(origin, direction);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1(world_, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {kNothingId, 0, 0, 0, 0, Eigen::Vector3f::Zero()};
  Hit hit;
  hit.id = ray.hit.geomID < alone_.size() ? int(ray.hit.geomID) : kTableId;
  hit.distance = ray.ray.tfar;
  hit.triangle = ray.hit.primID;
  hit.u = ray.hit.u;
  hit.v = ray.hit.v;
  hit.normal = Eigen::Vector3f(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z).normalized();
  if (hit.normal.dot(direction) > 0) hit.normal = -hit.normal;
  return hit;
}

bool RayWorld::meets(int object, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  RTCRay ray = makeRay(origin, direction).ray;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(alone_[object], &context, &ray);
  return ray.tfar < 0;
}

bool RayWorld::blocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float far) const {
  RTCRay ray = makeRay(origin, direction).ray;
  ray.tfar = far;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(world_, &context, &ray);
  return ray.tfar < 0;
}

Eigen::Vector3f RayWorld::smoothNormal(const Hit& hit) const {
  if (hit.id == kTableId) return hit.normal;
  const Eigen::Vector3f* corner = &corner_normals_[hit.id][3 * hit.triangle];
  const Eigen::Vector3f n =
      ((1 - hit.u - hit.v) * corner[0] + hit.u * corner[1] + hit.v * corner[2]).normalized();
  return n.dot(hit.normal) < 0 ? Eigen::Vector3f(-n) : n;
}

}  // namespace monocular_eye_hand
