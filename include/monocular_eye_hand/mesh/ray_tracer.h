#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/mesh/mesh.h"

struct RTCSceneTy;
struct RTCGeometryTy;

namespace monocular_eye_hand {

/// A ray from a point of a surface starts this far above it, or it would hit that surface [m].
inline constexpr float kRayLift = 2e-5f;

/// Meshes, or placed copies of other tracers, that rays meet: all that this package asks of Embree. Rays are
/// of single precision, in the frame of the tracer, lengths in units of their direction. The same meshes give
/// the same hits every time. Const calls are safe from several threads.
class RayTracer {
 public:
  enum class Kind {
    kStill,
    kWatertight,  ///< no ray slips through where two triangles meet
    kMoving       ///< copies are placed anew again and again: ready in no time, slower rays
  };
  explicit RayTracer(Kind kind = Kind::kStill);
  ~RayTracer();
  RayTracer(const RayTracer&) = delete;
  RayTracer& operator=(const RayTracer&) = delete;

  // Ids count up from 0 in the order of adding.
  int add(const Mesh& mesh, const Rigid3& tracer_from_mesh = {});
  int add(std::shared_ptr<const RayTracer> body);
  /// Of a copy that was added.
  void place(int id, const Rigid3& tracer_from_body);
  /// What is not shown no ray meets.
  void show(int id, bool shown);
  /// To be called when something was added, placed or shown, before the next ray.
  void commit();

  static constexpr int kNone = -1;
  struct Hit {
    int id = kNone;
    unsigned triangle = 0;
    float distance = 0;
    float u = 0, v = 0;                                ///< weights of the triangle's second and third corner
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< of any length, in the frame of the mesh or body
  };
  /// The first hit.
  Hit cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  /// True when something lies on origin + t direction, 0 < t < far.
  bool blocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float far) const;

  // Several rays at once, which is faster when they are neighbours.
  static constexpr int kLanes = 8;
  struct alignas(32) Rays {
    float ox[kLanes], oy[kLanes], oz[kLanes], dx[kLanes], dy[kLanes], dz[kLanes], far[kLanes];
    alignas(32) int valid[kLanes];  ///< -1: cast, 0: not

    /// The ray of lane k; whether it is cast is left to `valid`.
    void set(int k, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float until) {
      ox[k] = origin.x();
      oy[k] = origin.y();
      oz[k] = origin.z();
      dx[k] = direction.x();
      dy[k] = direction.y();
      dz[k] = direction.z();
      far[k] = until;
    }
  };
  struct Hits {
    float distance[kLanes], u[kLanes], v[kLanes];
    int id[kLanes];  ///< kNone: no hit, the lane's other fields are not set
    unsigned triangle[kLanes];
    Eigen::Vector3f normal[kLanes];  ///< as Hit::normal
  };
  /// First hits of the lanes from t = near on.
  void cast(const Rays& rays, float near, Hits* hits) const;
  /// blocked[k]: something lies on the ray before `far`; lanes that are not valid are not touched.
  void blocked(const Rays& rays, bool* blocked) const;

 private:
  RTCSceneTy* scene_;
  std::vector<RTCGeometryTy*> geometries_;
  std::vector<std::shared_ptr<const RayTracer>> bodies_;
};

/// Unit normal of a hit on the side that the ray came from.
inline Eigen::Vector3f facingNormal(const Eigen::Vector3f& normal, const Eigen::Vector3f& direction) {
  const Eigen::Vector3f n = normal.normalized();
  return n.dot(direction) > 0 ? Eigen::Vector3f(-n) : n;
}

}  // namespace monocular_eye_hand
