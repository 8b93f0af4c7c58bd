#pragma once
#include <memory>
#include <vector>

#include "monocular_eye_hand/mesh/ray_tracer.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// A Scene for rays: its objects in world coordinates, the table last.
class RayWorld {
 public:
  explicit RayWorld(const Scene& scene);

  struct Hit {
    int id;  ///< Scene::objects, kTableId or kNothingId
    float distance;
    uint32_t triangle;
    float u, v;
    Eigen::Vector3f normal;  ///< geometric, unit, towards the ray's origin
  };
  Hit cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  /// The same against one object only.
  bool meets(int object, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  /// True when something lies on origin + t direction, 0 < t < far.
  bool blocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float far) const {
    return world_.blocked(origin, direction, far);
  }
  /// Interpolated across surfaces that meet without a sharp edge, so that tessellated cylinders look round.
  Eigen::Vector3f smoothNormal(const Hit& hit) const;

 private:
  void add(const Mesh& mesh, const Rigid3& world_from_mesh);

  RayTracer world_;
  std::vector<std::unique_ptr<RayTracer>> alone_;             // each object without the others
  std::vector<std::vector<Eigen::Vector3f>> corner_normals_;  // three per triangle, world frame
};

}  // namespace monocular_eye_hand
