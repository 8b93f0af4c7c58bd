#include "monocular_eye_hand/model/interior.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/mesh/closest_point.h"
#include "monocular_eye_hand/mesh/ray_scene.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMaxCells = 20000;  // of the grid

bool anyInside(const ObjectModel& solid, const Rigid3& solid_from_points,
               const std::vector<Eigen::Vector3d>& points) {
  return std::any_of(points.begin(), points.end(),
                     [&](const Eigen::Vector3d& p) { return insideSolid(solid, solid_from_points * p); });
}

}  // namespace

bool insideSolid(const ObjectModel& model, const Eigen::Vector3d& p_in_object) {
  return model.closed && model.rays && model.bounds.contains(p_in_object) && model.rays->inside(p_in_object);
}

std::vector<Eigen::Vector3d> innerPoints(const ObjectModel& model, double depth, size_t max_points) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> depths;
  if (!model.closed || !model.rays || model.bounds.isEmpty()) return points;

  const double cell = std::max(depth, std::cbrt(model.bounds.volume() / kMaxCells));
  const Eigen::Array3i cells = (model.bounds.sizes() / cell).array().ceil().max(1).cast<int>();
  const Eigen::Vector3d step = model.bounds.sizes().array() / cells.cast<double>();

  const ClosestPoint surface(model.mesh);
  double deepest = 0;
  for (int i = 0; i < cells[0]; ++i)
    for (int j = 0; j < cells[1]; ++j)
      for (int k = 0; k < cells[2]; ++k) {
        const Eigen::Vector3d p =
            model.bounds.min() + step.cwiseProduct(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
        if (!insideSolid(model, p)) continue;
        points.push_back(p);
        depths.push_back(surface.distance(p, 2 * depth));
        deepest = std::max(deepest, depths.back());
      }

  const double wanted = std::min(depth, 0.7 * deepest);
  std::vector<Eigen::Vector3d> inner;
  for (size_t n = 0; n < points.size(); ++n)
    if (depths[n] >= wanted) inner.push_back(points[n]);

  const size_t stride = max_points > 0 ? (inner.size() + max_points - 1) / max_points : 1;
  std::vector<Eigen::Vector3d> spread;
  for (size_t n = 0; n < inner.size(); n += stride) spread.push_back(inner[n]);
  return spread;
}

bool interpenetrate(const ObjectModel& a, const std::vector<Eigen::Vector3d>& inner_a, const ObjectModel& b,
                    const std::vector<Eigen::Vector3d>& inner_b, const Rigid3& a_from_b) {
  const double apart = (a.centre() - a_from_b * b.centre()).norm();
  if (apart > (a.bounds.diagonal().norm() + b.bounds.diagonal().norm()) / 2) return false;
  return anyInside(b, a_from_b.inverse(), inner_a) || anyInside(a, a_from_b, inner_b);
}

}  // namespace monocular_eye_hand
