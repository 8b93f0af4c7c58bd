#include "simulation/render/visibility.h"

#include <cmath>
#include <opencv2/core.hpp>

namespace monocular_eye_hand {
namespace {

// Rectified box around an object's projection; the whole of `limits` when part of it is behind the camera.
cv::Rect projectedBox(const SceneObject& object, const Rigid3& camera_from_object, const Camera& camera,
                      const cv::Rect& limits) {
  double low_u = 1e9, high_u = -1e9, low_v = 1e9, high_v = -1e9;
  for (const auto& triangle : object.mesh->triangles)
    for (int vertex : triangle) {
      const Eigen::Vector3d p = camera_from_object * object.mesh->vertices[vertex];
      if (p.z() < 1e-3) return limits;
      const Eigen::Vector2d uv = camera.project(p);
      low_u = std::min(low_u, uv.x());
      high_u = std::max(high_u, uv.x());
      low_v = std::min(low_v, uv.y());
      high_v = std::max(high_v, uv.y());
    }
  const auto clip = [](double v) { return int(std::floor(std::min(1e6, std::max(-1e6, v)))); };
  const cv::Rect box(cv::Point(clip(low_u) - 1, clip(low_v) - 1),
                     cv::Point(clip(high_u) + 3, clip(high_v) + 3));
  return box & limits;
}

bool seenInImage(const Camera& camera, const Eigen::Vector2d& uv_rect) {
  const Eigen::Vector2d raw = camera.distort(uv_rect);
  if (raw.x() < -0.5 || raw.y() < -0.5 || raw.x() >= camera.width - 0.5 || raw.y() >= camera.height - 0.5)
    return false;
  return (camera.undistort(raw) - uv_rect).norm() < 0.01;  // else the lens model has folded back
}

}  // namespace

std::vector<Visibility> visibility(const Scene& scene, const RayWorld& world, const Camera& camera,
                                   const cv::Mat& ids) {
  std::vector<Visibility> out(scene.objects.size());
  for (int y = 0; y < ids.rows; ++y)
    for (int x = 0; x < ids.cols; ++x) {
      const int id = ids.at<short>(y, x);
      if (id < 0) continue;
      out[id].pixels_visible++;
      out[id].box_visible |= cv::Rect(x, y, 1, 1);
    }

  const Eigen::Vector3f origin = scene.world_from_camera.translation.cast<float>();
  const Eigen::Matrix3d& rotation = scene.world_from_camera.rotation;
  const auto meets = [&](size_t k, const Eigen::Vector2d& uv_rect) {
    return world.meets(int(k), origin, (rotation * camera.ray(uv_rect)).normalized().cast<float>());
  };

  std::vector<Eigen::Vector2d> rectified(ids.total());
  for (int y = 0; y < ids.rows; ++y)
    for (int x = 0; x < ids.cols; ++x)
      rectified[size_t(y) * ids.cols + x] = camera.undistort(Eigen::Vector2d(x, y));

  // Rectified pixels far outside the image stand for what the sensor misses.
  const cv::Rect around(-camera.width, -camera.height, 3 * camera.width, 3 * camera.height);
  for (size_t k = 0; k < out.size(); ++k) {
    const cv::Rect box = projectedBox(scene.objects[k], scene.cameraFromObject(int(k)), camera, around);
    out[k].pixels_alone = out[k].pixels_visible;
    for (int y = 0; y < ids.rows; ++y)
      for (int x = 0; x < ids.cols; ++x) {
        if (ids.at<short>(y, x) == int(k)) continue;
        const Eigen::Vector2d& uv = rectified[size_t(y) * ids.cols + x];
        if (!box.contains({int(std::floor(uv.x())), int(std::floor(uv.y()))})) continue;
        if (meets(k, uv)) out[k].pixels_alone++;
      }

    for (int y = box.y; y < box.y + box.height; ++y)
      for (int x = box.x; x < box.x + box.width; ++x) {
        const Eigen::Vector2d uv(x, y);
        const bool well_inside =
            !camera.distorted() && x >= 0 && y >= 0 && x < camera.width && y < camera.height;
        if (well_inside || seenInImage(camera, uv)) continue;
        if (meets(k, uv)) out[k].pixels_alone++;
      }
    if (out[k].pixels_alone > 0) out[k].fraction = double(out[k].pixels_visible) / out[k].pixels_alone;
  }
  return out;
}

}  // namespace monocular_eye_hand
