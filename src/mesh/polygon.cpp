#include <algorithm>

#include "mesh/mesh_readers.h"

namespace monocular_eye_hand {
namespace {

bool leftOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x()) > 0;
}

}  // namespace

void appendPolygon(const std::vector<Eigen::Vector3d>& vertices, const std::vector<int>& polygon,
                   std::vector<std::array<int, 3>>* triangles) {
  std::vector<int> left = polygon;
  constexpr size_t kLargest = 2000;  // ear clipping takes cubic time at worst
  if (left.size() > 3 && left.size() <= kLargest) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // Newell's method
    for (size_t k = 0; k < left.size(); ++k) {
      normal += vertices[left[k]].cross(vertices[left[(k + 1) % left.size()]]);
    }
    const Eigen::Vector3d n = normal.norm() > 0 ? normal.normalized() : Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d u = n.unitOrthogonal(), v = n.cross(u);
    const auto flat = [&](int i) { return Eigen::Vector2d(u.dot(vertices[i]), v.dot(vertices[i])); };

    while (left.size() > 3) {
      size_t ear = left.size();
      for (size_t k = 0; k < left.size() && ear == left.size(); ++k) {
        const int a = left[(k + left.size() - 1) % left.size()], b = left[k], c = left[(k + 1) % left.size()];
        const Eigen::Vector2d pa = flat(a), pb = flat(b), pc = flat(c);
        if (!leftOf(pa, pb, pc)) continue;
        const bool blocked = std::any_of(left.begin(), left.end(), [&](int i) {
          const Eigen::Vector2d p = flat(i);
          return i != a && i != b && i != c && leftOf(pa, pb, p) && leftOf(pb, pc, p) && leftOf(pc, pa, p);
        });
        if (!blocked) ear = k;
      }

      if (ear == left.size()) ear = 1;  // collinear or self-crossing: any cut is as good
      const size_t n_left = left.size();
      triangles->push_back({left[(ear + n_left - 1) % n_left], left[ear], left[(ear + 1) % n_left]});
      left.erase(left.begin() + long(ear));
    }
  }

  for (size_t k = 2; k < left.size(); ++k) triangles->push_back({left[0], left[k - 1], left[k]});
}

}  // namespace monocular_eye_hand
