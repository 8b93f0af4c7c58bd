#include "monocular_eye_hand/mesh/closest_point.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace monocular_eye_hand {
namespace {

double squaredDistanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = b - a;
  const double length2 = d.squaredNorm();
  const double s = length2 > 0 ? std::clamp(d.dot(p - a) / length2, 0.0, 1.0) : 0;
  return (p - a - s * d).squaredNorm();
}

}  // namespace

double squaredDistanceToTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& c) {
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const bool inside = n.dot((b - a).cross(p - a)) >= 0 && n.dot((c - b).cross(p - b)) >= 0 &&
                      n.dot((a - c).cross(p - c)) >= 0;
  const double n2 = n.squaredNorm();
  if (inside && n2 > 0) {
    const double h = n.dot(p - a);
    return h * h / n2;
  }
  return std::min({squaredDistanceToSegment(p, a, b), squaredDistanceToSegment(p, b, c),
                   squaredDistanceToSegment(p, c, a)});
}

ClosestPoint::ClosestPoint(const Mesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Eigen::AlignedBox3d> boxes(mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int v : mesh.triangles[t]) boxes[t].extend(mesh.vertices[v]);
  }
  nodes_.reserve(mesh.triangles.size());
  if (!order_.empty()) build(0, int(order_.size()), boxes);
}

int ClosestPoint::build(int begin, int end, const std::vector<Eigen::AlignedBox3d>& boxes) {
  const int id = int(nodes_.size());
  nodes_.emplace_back();
  Eigen::AlignedBox3d box;
  for (int k = begin; k < end; ++k) box.extend(boxes[order_[k]]);
  nodes_[id].box = box;
  nodes_[id].begin = begin;
  nodes_[id].end = end;
  if (end - begin <= 4) return id;

  Eigen::Index axis;
  box.diagonal().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int s, int t) {
    const double cs = boxes[s].min()[axis] + boxes[s].max()[axis];
    const double ct = boxes[t].min()[axis] + boxes[t].max()[axis];
    return cs != ct ? cs < ct : s < t;
  });

  const int left = build(begin, middle, boxes);
  const int right = build(middle, end, boxes);
  nodes_[id].left = left;
  nodes_[id].right = right;
  return id;
}

double ClosestPoint::distance(const Eigen::Vector3d& p, double limit) const {
  double best = limit * limit;
  int stack[128];
  int size = 0;
  if (!nodes_.empty()) stack[size++] = 0;

  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (node.box.squaredExteriorDistance(p) >= best) continue;

    if (node.left < 0) {
      for (int k = node.begin; k < node.end; ++k) {
        const auto& t = mesh_.triangles[order_[k]];
        best = std::min(best, squaredDistanceToTriangle(p, mesh_.vertices[t[0]], mesh_.vertices[t[1]],
                                                        mesh_.vertices[t[2]]));
      }
      continue;
    }

    const double dl = nodes_[node.left].box.squaredExteriorDistance(p);
    const double dr = nodes_[node.right].box.squaredExteriorDistance(p);
    // The nearer child is visited first: it stands on top.
    stack[size++] = dl < dr ? node.right : node.left;
    stack[size++] = dl < dr ? node.left : node.right;
  }
  return std::sqrt(best);
}

}  // namespace monocular_eye_hand
