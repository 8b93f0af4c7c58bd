#include "recognition/flat_view.h"

#include <algorithm>

#include "monocular_eye_hand/geometry/median.h"

namespace monocular_eye_hand {

FlatView flatten(const SampledView& view, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& centre,
                 double step) {
  FlatView flat;
  for (const ContourSample& s : view.contour) {
    const Eigen::Vector3d p = rotation * (s.p - centre) + Eigen::Vector3d(0, 0, view.distance);
    const Eigen::Vector3d t = rotation * s.tangent;
    const double scale = view.distance / p.z();
    flat.place.emplace_back(p.head<2>() * scale);
    flat.direction.emplace_back((t.head<2>() - p.head<2>() * (t.z() / p.z())) * scale);
    flat.feature.push_back(s.feature);
    flat.length += flat.direction.back().norm() * step;
  }
  return flat;
}

Eigen::Vector2d flatPoint(const Eigen::Vector3d& p_in_object, const SampledView& view,
                          const Eigen::Matrix3d& rotation, const Eigen::Vector3d& centre) {
  const Eigen::Vector3d p = rotation * (p_in_object - centre) + Eigen::Vector3d(0, 0, view.distance);
  return p.head<2>() * (view.distance / p.z());
}

double sampleStepOf(const SampledView& view) {
  std::vector<double> gaps;
  for (size_t i = 1; i < view.contour.size(); ++i)
    if (view.contour[i].feature == view.contour[i - 1].feature)
      gaps.push_back((view.contour[i].p - view.contour[i - 1].p).norm());
  if (gaps.empty()) return 0.01;
  return median(&gaps);
}

std::vector<int> spreadOrder(const std::vector<Eigen::Vector2d>& places, std::vector<double> nearest,
                             int count) {
  std::vector<int> order;
  while (int(order.size()) < count) {
    const int next = int(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    if (nearest[next] <= 0) break;
    order.push_back(next);
    for (size_t i = 0; i < places.size(); ++i)
      nearest[i] = std::min(nearest[i], (places[i] - places[next]).norm());
    nearest[next] = 0;
  }
  return order;
}

}  // namespace monocular_eye_hand
