#include "calibration/target_pose.h"

#include <Eigen/Geometry>
#include <array>
#include <limits>

#include "monocular_eye_hand/pose/p3p.h"
#include "monocular_eye_hand/pose/refine.h"

namespace monocular_eye_hand {
namespace {

/// The point farthest from the first, and the one that spans the largest triangle with these two.
std::array<size_t, 3> widestTriangle(const std::vector<TargetPoint>& points, size_t first) {
  std::array<size_t, 3> corners = {first, first, first};
  double farthest = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const double distance = (points[i].p_in_target - points[first].p_in_target).norm();
    if (distance <= farthest) continue;
    farthest = distance;
    corners[1] = i;
  }

  const Eigen::Vector3d side = points[corners[1]].p_in_target - points[first].p_in_target;
  double largest = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const double area = side.cross(points[i].p_in_target - points[first].p_in_target).norm();
    if (area <= largest) continue;
    largest = area;
    corners[2] = i;
  }
  return corners;
}

double squaredError(const std::vector<PointMatch>& matches, const Camera& camera, const Rigid3& pose) {
  double sum = 0;
  for (const PointMatch& m : matches) {
    if ((pose * m.p_in_object).z() <= 0) return std::numeric_limits<double>::infinity();
    sum += (pointResidual(pose, camera, m) / m.sigma).squaredNorm();
  }
  return sum;
}

}  // namespace

std::optional<Rigid3> targetPose(const CalibrationView& view, const Camera& camera) {
  if (view.points.size() < 4) return {};
  std::vector<PointMatch> matches;
  for (const TargetPoint& p : view.points)
    matches.push_back({p.p_in_target, camera.undistort(p.uv_raw), p.sigma});

  // From a corner of the target: farthest from the first of its points.
  const std::array<size_t, 3> corners = widestTriangle(view.points, widestTriangle(view.points, 0)[1]);
  Eigen::Matrix3d bearings, points;
  for (int k = 0; k < 3; ++k) {
    bearings.col(k) = camera.ray(matches[corners[size_t(k)]].uv).normalized();
    points.col(k) = matches[corners[size_t(k)]].p_in_object;
  }
  const PoseSolutions poses = solveP3P(bearings, points);

  std::optional<Rigid3> best;
  double least = std::numeric_limits<double>::infinity();
  RefineOptions options;
  options.max_iterations = 50;
  for (int k = 0; k < poses.count; ++k) {
    const RefinedPose refined = refinePose(poses.camera_from_object[size_t(k)], camera, {}, matches, options);
    const double error = squaredError(matches, camera, refined.camera_from_object);
    if (!refined.well_posed || !(error < least)) continue;
    least = error;
    best = refined.camera_from_object;
  }
  return best;
}

}  // namespace monocular_eye_hand
