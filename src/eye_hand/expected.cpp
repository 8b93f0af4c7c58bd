#include "eye_hand/expected.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/mesh/ray_scene.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kSamples = 60;  // vertices looked at, spread over the mesh

bool insideImage(const Camera& camera, const Eigen::Vector3d& p_in_camera, double border,
                 Eigen::Vector2d* uv_rect) {
  if (p_in_camera.z() <= 0) return false;
  *uv_rect = camera.project(p_in_camera);
  // The lens model holds near the image only.
  const Eigen::Vector2d size(camera.width, camera.height);
  if (((*uv_rect + size / 2).array() < 0).any() || ((*uv_rect - 1.5 * size).array() > 0).any()) return false;
  const Eigen::Vector2d uv_raw = camera.distort(*uv_rect);
  return uv_raw.x() >= border && uv_raw.y() >= border && uv_raw.x() <= camera.width - 1 - border &&
         uv_raw.y() <= camera.height - 1 - border;
}

bool hiddenBy(const PlacedModel& other, const Eigen::Vector3d& eye_in_base,
              const Eigen::Vector3d& p_in_base) {
  const Rigid3 object_from_base = other.base_from_object.inverse();
  return other.model->rays &&
         other.model->rays->occluded(object_from_base * eye_in_base, object_from_base * p_in_base);
}

}  // namespace

bool expectedInView(const std::vector<PlacedModel>& objects, size_t index, const Camera& camera,
                    const Rigid3& base_from_camera, const ObjectMapOptions& options) {
  const PlacedModel& object = objects[index];
  const std::vector<Eigen::Vector3d>& vertices = object.model->mesh.vertices;
  const Rigid3 camera_from_object = base_from_camera.inverse() * object.base_from_object;
  const double distance = (camera_from_object * object.model->centre()).norm();
  const double nearest = std::max(options.expected_nearest, object.model->diameter);
  if (distance < nearest || distance > options.expected_farthest) return false;

  const size_t step = std::max<size_t>(1, vertices.size() / kSamples);
  int all = 0, free = 0;
  Eigen::AlignedBox2d extent;
  for (size_t i = 0; i < vertices.size(); i += step) {
    ++all;
    Eigen::Vector2d uv_rect;
    if (!insideImage(camera, camera_from_object * vertices[i], options.expected_border, &uv_rect)) continue;
    extent.extend(uv_rect);
    const Eigen::Vector3d p_in_base = object.base_from_object * vertices[i];
    bool hidden = false;
    for (size_t k = 0; k < objects.size() && !hidden; ++k)
      hidden = k != index && hiddenBy(objects[k], base_from_camera.translation, p_in_base);
    free += !hidden;
  }

  return free > 0 && free >= options.expected_share * all &&
         extent.diagonal().norm() >= options.expected_size;
}

}  // namespace monocular_eye_hand
