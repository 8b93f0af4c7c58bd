#include <algorithm>
#include <array>
#include <cmath>

#include "monocular_eye_hand/pose/p3p.h"
#include "monocular_eye_hand/recognition/hypotheses.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMaxPointSigma = 4.0;    // a far end less certain than this fixes no pose [px]
constexpr int kMaxPerKind = 300;          // best image groupings tried per kind
constexpr double kFourthPointError = 10;  // largest image error of the fourth point [px]

bool usablePoints(const Grouping& grouping) {
  if (grouping.points.size() < 3) return false;
  for (double sigma : grouping.sigma)
    if (sigma > kMaxPointSigma) return false;
  return true;
}

bool pointKind(GroupingKind kind) {
  return kind == GroupingKind::kJunction || kind == GroupingKind::kTriplet || kind == GroupingKind::kChain ||
         kind == GroupingKind::kQuad;
}

// Of the points the three that span the largest triangle: P3P is best conditioned there.
std::array<int, 3> widestTriangle(const std::vector<Eigen::Vector2d>& p) {
  std::array<int, 3> best{0, 1, 2};
  double largest = -1;
  const int n = int(p.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k) {
        const Eigen::Vector2d a = p[j] - p[i], b = p[k] - p[i];
        const double area = std::abs(a.x() * b.y() - a.y() * b.x());
        if (area > largest) largest = area, best = {i, j, k};
      }
  return best;
}

void solvePair(const SearchContext& context, const Grouping& seen, const ModelGrouping& known,
               const Correspondence& order, HypothesisPool* pool, WorkBudget* budget) {
  const std::array<int, 3> use = widestTriangle(seen.points);
  Eigen::Matrix3d bearings, points;
  for (int i = 0; i < 3; ++i) {
    bearings.col(i) = context.camera.ray(seen.points[use[i]]).normalized();
    points.col(i) = known.points[order.points[use[i]]];
  }
  const PoseSolutions poses = solveP3P(bearings, points);
  for (int i = 0; i < poses.count; ++i) {
    const Rigid3& pose = poses.camera_from_object[i];
    bool consistent = true;
    for (size_t k = 0; k < seen.points.size() && consistent; ++k) {
      const Eigen::Vector3d p = pose * known.points[order.points[k]];
      consistent = p.z() > 0 && (context.camera.project(p) - seen.points[k]).norm() < kFourthPointError;
    }
    if (consistent) pool->offer(pose, seen.kind, context.map, budget);
  }
}

}  // namespace

void hypothesesFromPoints(const SearchContext& context, int object, const SearchModel& model,
                          HypothesisPool* pool, WorkBudget* budget) {
  std::array<int, 16> tried{};
  for (const Grouping& seen : context.groupings) {  // best first within a kind
    if (!pointKind(seen.kind) || !usablePoints(seen)) continue;
    if (std::find(seen.candidates.begin(), seen.candidates.end(), object) == seen.candidates.end()) continue;
    if (++tried[size_t(seen.kind)] > kMaxPerKind) continue;
    for (const ModelGrouping& known : model.groupings()) {
      if (known.kind != seen.kind || known.points.size() != seen.points.size()) continue;
      for (const Correspondence& order : correspondences(seen, known)) {
        if (budget->spent()) return;
        solvePair(context, seen, known, order, pool, budget);
      }
    }
  }
}

}  // namespace monocular_eye_hand
