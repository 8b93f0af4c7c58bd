#include "monocular_eye_hand/mesh/ray_scene.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

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

template <class Ray>
void setRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, float far, Ray* ray) {
  ray->org_x = float(origin.x());
  ray->org_y = float(origin.y());
  ray->org_z = float(origin.z());
  ray->dir_x = float(direction.x());
  ray->dir_y = float(direction.y());
  ray->dir_z = float(direction.z());
  ray->tnear = 0;
  ray->tfar = far;
  ray->time = 0;
  ray->mask = ~0u;
  ray->flags = 0;
}

}  // namespace

struct RayScene::Impl {
  RTCScene scene = nullptr;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // single precision is finest near the origin
  ~Impl() {
    if (scene) rtcReleaseScene(scene);
  }
};

RayScene::RayScene(const Mesh& mesh) : impl_(new Impl) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  if (!mesh.vertices.empty()) impl_->centre = box.center();

  impl_->scene = rtcNewScene(device());
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_HIGH);

  const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  for (const Eigen::Vector3d& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) *v++ = float(p[k] - impl_->centre[k]);
  }
  auto* t = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) *t++ = unsigned(corner);
  }

  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  // On one thread: the same tree, and so the same hits, every time.
  tbb::task_arena(1).execute([&] { rtcCommitScene(impl_->scene); });
}

RayScene::~RayScene() = default;

RayScene::Hit RayScene::cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& unit_direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  setRay(origin - impl_->centre, unit_direction, std::numeric_limits<float>::infinity(), &query.ray);
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {true, double(query.ray.tfar), int(query.hit.primID)};
}

bool RayScene::occluded(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray;
  setRay(from - impl_->centre, to - from, 1.0f, &ray);
  rtcOccluded1(impl_->scene, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace monocular_eye_hand
