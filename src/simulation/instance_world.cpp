#include "simulation/instance_world.h"

#include <Eigen/Geometry>
#include <stdexcept>

#include "simulation/corner_normals.h"

namespace monocular_eye_hand {
namespace {

RTCScene bodyScene(RTCDevice device, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  for (const Eigen::Vector3d& p : mesh.vertices)
    for (int k = 0; k < 3; ++k) *vertices++ = float(p[k]);
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles)
    for (int v : triangle) *indices++ = unsigned(v);
  rtcCommitGeometry(geometry);
  RTCScene scene = rtcNewScene(device);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

RTCGeometry instanceOf(RTCDevice device, RTCScene body, RTCScene world, unsigned id) {
  RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, body);
  rtcAttachGeometryByID(world, instance, id);
  return instance;
}

void setPose(RTCGeometry instance, const Rigid3& world_from_body) {
  float matrix[12];
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row)
      matrix[3 * column + row] =
          float(column < 3 ? world_from_body.rotation(row, column) : world_from_body.translation[row]);
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
  rtcCommitGeometry(instance);
}

// Lane k of a packet of Embree's.
void setLane(const InstanceWorld::Rays& rays, int k, float near, RTCRay8* packet) {
  packet->org_x[k] = rays.ox[k];
  packet->org_y[k] = rays.oy[k];
  packet->org_z[k] = rays.oz[k];
  packet->dir_x[k] = rays.dx[k];
  packet->dir_y[k] = rays.dy[k];
  packet->dir_z[k] = rays.dz[k];
  packet->tnear[k] = near;
  packet->tfar[k] = rays.far[k];
  packet->time[k] = 0;
  packet->mask[k] = ~0u;
  packet->id[k] = 0;
  packet->flags[k] = 0;
}

}  // namespace

InstanceWorld::InstanceWorld(const std::vector<const Mesh*>& meshes) {
  device_ = rtcNewDevice("threads=1,set_affinity=0");
  if (!device_) throw std::runtime_error("Embree gave no device");
  all_ = rtcNewScene(device_);
  seen_ = rtcNewScene(device_);
  for (RTCScene world : {all_, seen_}) {
    rtcSetSceneFlags(world, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(world, RTC_BUILD_QUALITY_LOW);
  }
  for (const Mesh* mesh : meshes) {
    const unsigned id = unsigned(bodies_.size());
    bodies_.push_back(bodyScene(device_, *mesh));
    instances_.push_back(instanceOf(device_, bodies_.back(), all_, id));
    seen_instances_.push_back(instanceOf(device_, bodies_.back(), seen_, id));
    corner_normals_.push_back(cornerNormals(*mesh, Eigen::Matrix3d::Identity()));
  }
  rotations_.assign(meshes.size(), Eigen::Matrix3f::Identity());
}

InstanceWorld::~InstanceWorld() {
  for (RTCGeometry instance : instances_) rtcReleaseGeometry(instance);
  for (RTCGeometry instance : seen_instances_) rtcReleaseGeometry(instance);
  rtcReleaseScene(all_);
  rtcReleaseScene(seen_);
  for (RTCScene body : bodies_) rtcReleaseScene(body);
  rtcReleaseDevice(device_);
}

void InstanceWorld::place(const std::vector<Rigid3>& world_from_body, const std::vector<bool>& seen) {
  for (size_t k = 0; k < instances_.size(); ++k) {
    rotations_[k] = world_from_body[k].rotation.cast<float>();
    setPose(instances_[k], world_from_body[k]);
    setPose(seen_instances_[k], world_from_body[k]);
    if (seen[k])
      rtcEnableGeometry(seen_instances_[k]);
    else
      rtcDisableGeometry(seen_instances_[k]);
  }
  rtcCommitScene(all_);
  rtcCommitScene(seen_);
}

void InstanceWorld::cast(const Rays& rays, float near, Hits* hits) const {
  RTCRayHit8 packet;
  for (int k = 0; k < kLanes; ++k) {
    setLane(rays, k, near, &packet.ray);
    packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(rays.valid, seen_, &context, &packet);

  for (int k = 0; k < kLanes; ++k) {
    const unsigned body = packet.hit.instID[0][k];
    hits->body[k] = rays.valid[k] && packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID ? int(body) : -1;
    if (hits->body[k] < 0) continue;
    hits->t[k] = packet.ray.tfar[k];
    hits->u[k] = packet.hit.u[k];
    hits->v[k] = packet.hit.v[k];
    hits->triangle[k] = packet.hit.primID[k];
    const Eigen::Vector3f in_body(packet.hit.Ng_x[k], packet.hit.Ng_y[k], packet.hit.Ng_z[k]);
    Eigen::Vector3f n = (rotations_[body] * in_body).normalized();
    if (n.dot(Eigen::Vector3f(rays.dx[k], rays.dy[k], rays.dz[k])) > 0) n = -n;
    hits->normal[k] = n;
  }
}

void InstanceWorld::blocked(const Rays& rays, bool* blocked) const {
  RTCRay8 packet;
  for (int k = 0; k < kLanes; ++k) setLane(rays, k, 0, &packet);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded8(rays.valid, all_, &context, &packet);
  for (int k = 0; k < kLanes; ++k)
    if (rays.valid[k]) blocked[k] = packet.tfar[k] < 0;
}

Eigen::Vector3f InstanceWorld::smoothNormal(int body, unsigned triangle, float u, float v,
                                            const Eigen::Vector3f& geometric) const {
  const Eigen::Vector3f* corner = &corner_normals_[size_t(body)][3 * triangle];
  const Eigen::Vector3f n =
      rotations_[size_t(body)] * ((1 - u - v) * corner[0] + u * corner[1] + v * corner[2]).normalized();
  return n.dot(geometric) < 0 ? Eigen::Vector3f(-n) : n;
}

}  // namespace monocular_eye_hand
