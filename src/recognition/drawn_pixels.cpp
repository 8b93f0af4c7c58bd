#include "recognition/drawn_pixels.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "monocular_eye_hand/mesh/ray_scene.h"

namespace monocular_eye_hand {

int latticeStep(const cv::Rect& box, int max_rays) {
  int step = 2;
  while (step < kCoverCell && box.area() / (step * step) > max_rays) step *= 2;
  return step;
}

std::vector<DrawnPixel> drawnPixels(const ObjectModel& model, const SearchImage& image,
                                    const Candidate& candidate, int step) {
  const cv::Rect& box = candidate.bounding_box;
  const Rigid3 object_from_camera = candidate.pose.camera_from_object.inverse();
  const auto firstOnLattice = [step](int start, int origin) {
    return start + ((origin - start) % step + step) % step;
  };
  std::vector<DrawnPixel> pixels;
  for (int v = firstOnLattice(box.y, image.domain.v0); v < box.y + box.height; v += step)
    for (int u = firstOnLattice(box.x, image.domain.u0); u < box.x + box.width; u += step) {
      const Eigen::Vector3d ray =
          (object_from_camera.rotation * image.camera.ray({double(u), double(v)})).normalized();
      const RayScene::Hit hit = model.rays->cast(object_from_camera.translation, ray);
      if (hit.hit) pixels.push_back({u, v, hit.triangle, hit.distance});
    }
  return pixels;
}

std::vector<DrawnPixel> unhidden(std::vector<DrawnPixel> pixels, const SearchImage& image,
                                 const Candidate& candidate) {
  const auto isHidden = [&](const DrawnPixel& p) {
    return std::any_of(candidate.occluders.begin(), candidate.occluders.end(), [&](const Occluder& o) {
      return o.hides(image.camera, {double(p.u), double(p.v)}, p.distance);
    });
  };
  pixels.erase(std::remove_if(pixels.begin(), pixels.end(), isHidden), pixels.end());
  return pixels;
}

Eigen::Vector3f normalInCamera(const ObjectModel& model, const Candidate& candidate,
                               const DrawnPixel& pixel) {
  const std::array<int, 3>& corners = model.mesh.triangles[size_t(pixel.triangle)];
  const Eigen::Vector3d& a = model.mesh.vertices[size_t(corners[0])];
  const Eigen::Vector3d& b = model.mesh.vertices[size_t(corners[1])];
  const Eigen::Vector3d& c = model.mesh.vertices[size_t(corners[2])];
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  return (candidate.pose.camera_from_object.rotation * normal).cast<float>();
}

}  // namespace monocular_eye_hand
