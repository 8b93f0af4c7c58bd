#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/characteristic_views.h"

namespace monocular_eye_hand {
namespace {

constexpr double kLargestGap = 0.72;  // of the spacing; a little below what the header promises

/// Evenly spread directions along a golden spiral (Gonzalez 2010).
std::vector<Eigen::Vector3d> spiral(int count) {
  std::vector<Eigen::Vector3d> out;
  const double golden = M_PI * (3 - std::sqrt(5.0));
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(std::max(0.0, 1 - z * z));
    out.emplace_back(r * std::cos(golden * k), r * std::sin(golden * k), z);
  }
  return out;
}

/// In general position to every symmetry axis a part is likely to have.
Eigen::Vector3d generic() { return Eigen::Vector3d(0.3819, 0.7071, 0.5953).normalized(); }

bool inDomain(const Eigen::Vector3d& d, const Symmetries& symmetries) {
  const double own = d.dot(generic());
  return std::all_of(symmetries.discrete.begin(), symmetries.discrete.end(),
                     [&](const Rigid3& g) { return (g.rotation * d).dot(generic()) <= own + 1e-12; });
}

/// Largest dot product of d with a symmetric copy of the directions.
double nearest(const Eigen::Vector3d& d, const std::vector<Eigen::Vector3d>& directions,
               const Symmetries& symmetries) {
  double best = -1;
  for (const Rigid3& g : symmetries.discrete) {
    const Eigen::Vector3d copy = g.rotation * d;
    for (const Eigen::Vector3d& o : directions) best = std::max(best, copy.dot(o));
  }
  return best;
}

std::vector<Eigen::Vector3d> meridian(const Symmetries& symmetries, double spacing) {
  const Eigen::Vector3d axis = symmetries.axis->direction, out = axis.unitOrthogonal();
  const double end = symmetries.discrete.size() > 1 ? M_PI / 2 : M_PI;
  const int steps = std::max(1, int(std::ceil(end / spacing - 1e-9)));
  std::vector<Eigen::Vector3d> directions;
  for (int k = 0; k <= steps; ++k) {
    const double tilt = end * k / steps;
    directions.push_back(std::cos(tilt) * axis + std::sin(tilt) * out);
  }
  return directions;
}

}  // namespace

std::vector<Eigen::Vector3d> viewDirections(const Symmetries& symmetries, double spacing) {
  if (!(spacing >= 0.05 && spacing <= 1.6)) {
    throw BadInput(
        fmt::format("the spacing of view directions is {:g}; it must be 0.05 to 1.6 rad", spacing));
  }
  if (symmetries.sphere) return {generic()};
  if (symmetries.axis) return meridian(symmetries, spacing);

  // Points of a hexagonal grid of this spacing own spacing^2 sqrt(3) / 2 each.
  const int count = std::max(12, int(std::ceil(4 * M_PI / (0.8660254 * spacing * spacing))));
  std::vector<Eigen::Vector3d> directions;
  for (const Eigen::Vector3d& d : spiral(count)) {
    if (inDomain(d, symmetries)) directions.push_back(d);
  }

  // The seams of the domain, and the poles of the spiral, can leave gaps: the worst is filled until none is
  // left.
  std::vector<Eigen::Vector3d> probes;
  for (const Eigen::Vector3d& d : spiral(30 * count)) {
    if (inDomain(d, symmetries)) probes.push_back(d);
  }
  std::vector<double> closeness;
  for (const Eigen::Vector3d& p : probes) closeness.push_back(nearest(p, directions, symmetries));

  while (!probes.empty()) {
    const size_t worst = size_t(std::min_element(closeness.begin(), closeness.end()) - closeness.begin());
    if (closeness[worst] >= std::cos(kLargestGap * spacing)) break;
    directions.push_back(probes[worst]);
    for (size_t k = 0; k < probes.size(); ++k) {
      closeness[k] = std::max(closeness[k], nearest(probes[k], {probes[worst]}, symmetries));
    }
  }
  return directions;
}

}  // namespace monocular_eye_hand
