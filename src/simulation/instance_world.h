#pragma once
#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// Rigid bodies for Embree, built once and placed anew for every frame.
class InstanceWorld {
 public:
  explicit InstanceWorld(const std::vector<const Mesh*>& meshes);
  ~InstanceWorld();
  InstanceWorld(const InstanceWorld&) = delete;
  InstanceWorld& operator=(const InstanceWorld&) = delete;

  /// `seen[k]` false: body k casts shadows, but no camera ray meets it.
  void place(const std::vector<Rigid3>& world_from_body, const std::vector<bool>& seen);

  static constexpr int kLanes = 8;
  struct alignas(32) Rays {  ///< lanes of a packet
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
    float t[kLanes], u[kLanes], v[kLanes];
    int body[kLanes];  ///< -1: none
    unsigned triangle[kLanes];
    Eigen::Vector3f normal[kLanes];  ///< geometric, world, unit, towards the origin
  };
  /// First hits of the lanes from t = near on.
  void cast(const Rays& rays, float near, Hits* hits) const;
  /// blocked[k]: something lies on the ray before `far`; lanes that are not valid are not touched.
  void blocked(const Rays& rays, bool* blocked) const;
  /// Interpolated over curved surfaces.
  Eigen::Vector3f smoothNormal(int body, unsigned triangle, float u, float v,
                               const Eigen::Vector3f& geometric) const;

 private:
  RTCDevice device_;
  RTCScene all_, seen_;
  std::vector<RTCScene> bodies_;
  std::vector<RTCGeometry> instances_, seen_instances_;
  std::vector<Eigen::Matrix3f> rotations_;
  std::vector<std::vector<Eigen::Vector3f>> corner_normals_;  // body frame
};

}  // namespace monocular_eye_hand
