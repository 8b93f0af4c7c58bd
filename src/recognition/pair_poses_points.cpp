#include <algorithm>
#include <array>
#include <cmath>

#include "monocular_eye_hand/pose/corner_pose.h"
#include "monocular_eye_hand/pose/p3p.h"
#include "recognition/pair_poses.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMaxPointSigma = 4.0;    // a far end less certain than this fixes no pose [px]
constexpr double kFourthPointError = 10;  // largest image error of a point that must agree [px]

bool certain(const Grouping& grouping, int point) { return grouping.sigma[point] <= kMaxPointSigma; }

int certainPoints(const Grouping& grouping) {
  int count = 0;
  for (int i = 0; i < int(grouping.points.size()); ++i) count += certain(grouping, i);
  return count;
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
        if (area > largest) {
          largest = area;
          best = {i, j, k};
        }
      }
  return best;
}

// Whether the object is surely nearer than it is looked for when its points (columns, object frame) are seen
// on these bearings: neither end of a side is farther away than its length over the sine of its angle.
bool surelyTooNear(const DistanceRange& range, const ObjectModel& model, const Eigen::Matrix3d& bearings,
                   const Eigen::Matrix3d& points) {
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    const double length = (points.col(i) - points.col(next)).norm();
    const double sine = bearings.col(i).cross(bearings.col(next)).norm();
    const double apart = (points.col(i) - model.centre()).norm();
    if (length + apart * sine < range.nearest * sine) return true;
  }
  return false;
}

}  // namespace

bool fixesPose(const Grouping& seen) {
  switch (seen.kind) {
    case GroupingKind::kEdge:
      return false;  // searched with the view sphere
    case GroupingKind::kJunction:
    case GroupingKind::kChain:
    case GroupingKind::kQuad:
    case GroupingKind::kParallelPair:
      return certainPoints(seen) == int(seen.points.size());
    case GroupingKind::kTriplet:  // its three lines and one whole edge are enough
      return certain(seen, 0) && certainPoints(seen) >= 2;
    case GroupingKind::kEllipse:
    case GroupingKind::kEllipsePair:
    case GroupingKind::kEllipseLine:
      return true;
  }
  return false;
}

void posesOfPoints(const SearchImage& image, const ObjectModel& model, const DistanceRange& range,
                   const GroupingPair& pair, std::vector<Rigid3>* poses) {
  const auto& [seen, known, order] = pair;
  const std::array<int, 3> use = widestTriangle(seen.points);
  Eigen::Matrix3d bearings, points;
  for (int i = 0; i < 3; ++i) {
    bearings.col(i) = image.camera.ray(seen.points[use[i]]).normalized();
    points.col(i) = known.points[order.points[use[i]]];
  }
  if (surelyTooNear(range, model, bearings, points)) return;

  const PoseSolutions roots = solveP3P(bearings, points);
  for (int i = 0; i < roots.count; ++i) {
    const Rigid3& pose = roots.camera_from_object[i];
    bool consistent = true;
    for (size_t k = 0; k < seen.points.size() && consistent; ++k) {
      const Eigen::Vector3d p = pose * known.points[order.points[k]];
      consistent = p.z() > 0 && (image.camera.project(p) - seen.points[k]).norm() < kFourthPointError;
    }
    if (consistent) poses->push_back(pose);
  }
}

void posesOfCorner(const SearchImage& image, const GroupingPair& pair, std::vector<Rigid3>* poses) {
  const auto& [seen, known, order] = pair;
  const Eigen::Vector3d& corner = known.points[order.points[0]];
  CornerObservation observed;
  observed.corner = image.camera.ray(seen.points[0]).normalized();
  Eigen::Matrix3d directions;
  for (int i = 0; i < 3; ++i) {
    observed.far_points.col(i) = image.camera.ray(seen.points[i + 1]).normalized();
    directions.col(i) = (known.points[order.points[i + 1]] - corner).normalized();
  }
  for (const Eigen::Matrix3d& rotation : cornerRotations(observed, directions))
    for (int i = 0; i < 3; ++i) {  // each whole edge gives a distance
      if (!certain(seen, i + 1)) continue;
      const double depth =
          cornerDepth(observed.corner, observed.far_points.col(i), rotation * directions.col(i),
                      (known.points[order.points[i + 1]] - corner).norm());
      if (depth > 0) poses->push_back({rotation, depth * observed.corner - rotation * corner});
    }
}

void posesOfPair(const SearchImage& image, const ObjectModel& model, const DistanceRange& range,
                 const GroupingPair& pair, std::vector<Rigid3>* poses) {
  switch (pair.seen.kind) {
    case GroupingKind::kEdge:
      return;
    case GroupingKind::kTriplet:
      if (certainPoints(pair.seen) < 4) return posesOfCorner(image, pair, poses);
      [[fallthrough]];
    case GroupingKind::kJunction:
    case GroupingKind::kChain:
    case GroupingKind::kQuad:
    case GroupingKind::kParallelPair:
      return posesOfPoints(image, model, range, pair, poses);
    case GroupingKind::kEllipse:
      return posesOfEllipse(image, model, range, pair, poses);
    case GroupingKind::kEllipsePair:
      return posesOfEllipsePair(image, model, range, pair, poses);
    case GroupingKind::kEllipseLine:
      return posesOfEllipseLine(image, model, range, pair, poses);
  }
}

}  // namespace monocular_eye_hand
