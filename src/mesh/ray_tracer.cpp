#include "monocular_eye_hand/mesh/ray_tracer.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace monocular_eye_hand {
namespace {

/// One device serves all scenes; it lives until the program ends. Its number of threads is left alone: Embree
/// would hold the whole process, and all that works with TBB in it, to that number.
RTCDevice device() {
  static const RTCDevice shared = rtcNewDevice(nullptr);
  if (!shared)
    throw std::runtime_error("Embree cannot start: error " + std::to_string(rtcGetDeviceError(nullptr)));
  return shared;
}

template <class T>
T* newBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, size_t count) {
  return static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, 3 * sizeof(T), count));
}

void setRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float far, RTCRay* ray) {
  ray->org_x = origin.x();
  ray->org_y = origin.y();
  ray->org_z = origin.z();
  ray->dir_x = direction.x();
  ray->dir_y = direction.y();
  ray->dir_z = direction.z();
  ray->tnear = 0;
  ray->tfar = far;
  ray->time = 0;
  ray->mask = ~0u;
  ray->id = 0;
  ray->flags = 0;
}

/// Lane k of a packet of Embree's.
void setLane(const RayTracer::Rays& rays, int k, float near, RTCRay8* packet) {
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

/// Of a copy the copy, of a mesh the mesh.
int idOf(unsigned geometry, unsigned instance) {
  if (geometry == RTC_INVALID_GEOMETRY_ID) return RayTracer::kNone;
  return int(instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance);
}

}  // namespace

RayTracer::RayTracer(Kind kind) : scene_(rtcNewScene(device())) {
  if (kind == Kind::kWatertight) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
  } else if (kind == Kind::kMoving) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
  }
}

RayTracer::~RayTracer() {
  for (RTCGeometry geometry : geometries_) rtcReleaseGeometry(geometry);
  rtcReleaseScene(scene_);
}

int RayTracer::add(const Mesh& mesh, const Rigid3& tracer_from_mesh) {
  const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = newBuffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices.size());
  for (const Eigen::Vector3d& p : mesh.vertices) {
    const Eigen::Vector3d q = tracer_from_mesh * p;
    for (int k = 0; k < 3; ++k) *vertex++ = float(q[k]);
  }

  auto* corner =
      newBuffer<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (const int v : triangle) *corner++ = unsigned(v);
  }

  rtcCommitGeometry(geometry);
  geometries_.push_back(geometry);
  return int(rtcAttachGeometry(scene_, geometry));
}

int RayTracer::add(std::shared_ptr<const RayTracer> body) {
  const RTCGeometry instance = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, body->scene_);
  bodies_.push_back(std::move(body));
  geometries_.push_back(instance);
  return int(rtcAttachGeometry(scene_, instance));
}

void RayTracer::place(int id, const Rigid3& tracer_from_body) {
  float columns[12];
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      columns[3 * column + row] = float(tracer_from_body.rotation(row, column));
    columns[9 + row] = float(tracer_from_body.translation[row]);
  }
  const RTCGeometry instance = geometries_[size_t(id)];
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  rtcCommitGeometry(instance);
}

void RayTracer::show(int id, bool shown) {
  if (shown) {
    rtcEnableGeometry(geometries_[size_t(id)]);
  } else {
    rtcDisableGeometry(geometries_[size_t(id)]);
  }
}

void RayTracer::commit() {
  // On one thread: the same tree, and so the same hits, every time.
  tbb::task_arena(1).execute([&] { rtcCommitScene(scene_); });
}

RayTracer::Hit RayTracer::cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  setRay(origin, direction, std::numeric_limits<float>::infinity(), &query.ray);
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_, &context, &query);

  const int id = idOf(query.hit.geomID, query.hit.instID[0]);
  if (id == kNone) return {};
  return {id,          query.hit.primID, query.ray.tfar,
          query.hit.u, query.hit.v,      {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}};
}

bool RayTracer::blocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float far) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray;
  setRay(origin, direction, far, &ray);
  rtcOccluded1(scene_, &context, &ray);
  return ray.tfar < 0;
}

void RayTracer::cast(const Rays& rays, float near, Hits* hits) const {
  RTCRayHit8 packet;
  for (int k = 0; k < kLanes; ++k) {
    setLane(rays, k, near, &packet.ray);
    packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(rays.valid, scene_, &context, &packet);

  for (int k = 0; k < kLanes; ++k) {
    hits->id[k] = rays.valid[k] ? idOf(packet.hit.geomID[k], packet.hit.instID[0][k]) : kNone;
    if (hits->id[k] == kNone) continue;
    hits->distance[k] = packet.ray.tfar[k];
    hits->u[k] = packet.hit.u[k];
    hits->v[k] = packet.hit.v[k];
    hits->triangle[k] = packet.hit.primID[k];
    hits->normal[k] = {packet.hit.Ng_x[k], packet.hit.Ng_y[k], packet.hit.Ng_z[k]};
  }
}

void RayTracer::blocked(const Rays& rays, bool* blocked) const {
  RTCRay8 packet;
  for (int k = 0; k < kLanes; ++k) setLane(rays, k, 0, &packet);

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded8(rays.valid, scene_, &context, &packet);

  for (int k = 0; k < kLanes; ++k) {
    if (rays.valid[k]) blocked[k] = packet.tfar[k] < 0;
  }
}

}  // namespace monocular_eye_hand
