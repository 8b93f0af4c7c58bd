#include <algorithm>
#include <random>

#include "monocular_eye_hand/planning/path_planner.h"

namespace monocular_eye_hand {
namespace {

/// The farthest corner that each corner sees.
void skipCorners(std::vector<JointVector>* points, const PathTest& test, double resolution, int* tests) {
  std::vector<JointVector> kept{points->front()};
  for (size_t at = 0; at + 1 < points->size();) {
    size_t next = points->size() - 1;
    while (next > at + 1 && !edgeFree(test, (*points)[at], (*points)[next], resolution, false, tests)) --next;
    kept.push_back((*points)[next]);
    at = next;
  }
  *points = std::move(kept);
}

struct PathPoint {
  size_t edge;
  JointVector joints;
};

PathPoint along(const std::vector<JointVector>& points, double s) {
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    const double length = (points[i + 1] - points[i]).norm();
    if (s <= length || i + 2 == points.size())
      return {i, points[i] + (points[i + 1] - points[i]) * (length > 0 ? std::min(1.0, s / length) : 0)};
    s -= length;
  }
  return {0, points.front()};
}

double lengthOf(const std::vector<JointVector>& points) {
  double length = 0;
  for (size_t i = 0; i + 1 < points.size(); ++i) length += (points[i + 1] - points[i]).norm();
  return length;
}

}  // namespace

void shorten(std::vector<JointVector>* points, const PathTest& test, const PathOptions& options, int* tests) {
  if (points->size() < 3) return;
  skipCorners(points, test, options.resolution, tests);
  std::mt19937_64 random(options.seed);
  for (int i = 0; i < options.shortcuts && points->size() > 2; ++i) {
    const double length = lengthOf(*points);
    const double u = double(random() >> 11) / 9007199254740992.0,
                 v = double(random() >> 11) / 9007199254740992.0;
    const PathPoint a = along(*points, length * std::min(u, v)), b = along(*points, length * std::max(u, v));
    if (a.edge == b.edge) continue;

    double old = (b.joints - (*points)[b.edge]).norm();
    old += ((*points)[a.edge + 1] - a.joints).norm();
    for (size_t k = a.edge + 1; k < b.edge; ++k) old += ((*points)[k + 1] - (*points)[k]).norm();
    if ((b.joints - a.joints).norm() > 0.98 * old) continue;
    if (!edgeFree(test, a.joints, b.joints, options.resolution, false, tests)) continue;
    points->erase(points->begin() + a.edge + 1, points->begin() + b.edge + 1);
    points->insert(points->begin() + a.edge + 1, {a.joints, b.joints});
  }

  skipCorners(points, test, options.resolution, tests);
}

}  // namespace monocular_eye_hand
