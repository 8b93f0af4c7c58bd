#include "monocular_eye_hand/task/camera_views.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/look_at.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

constexpr int kRolls = 12;
constexpr int kDirections = 5;         // then from the first one again
constexpr double kJointWeight = 0.25;  // of a joint's path against the departure from the desired view
constexpr double kMinWrist = 0.05;     // |sin q5|: nearer to the singularity the arm cannot move on

struct DesiredView {
  double azimuth, elevation, distance;  // of the camera from the target [rad], [m]
};

/// 0, 1, -1, 2, -2, ...
int alternating(int i) { return i % 2 ? (i + 1) / 2 : -i / 2; }

DesiredView desiredView(const TaskView& view, const Eigen::Vector3d& target, const CameraViewOptions& o) {
  const double towards_robot = std::atan2(-target.y(), -target.x());
  if (view.search)
    return {towards_robot + alternating(view.direction % kDirections) * o.overview_azimuth_step,
            o.search_elevation, o.search_distance};
  if (!view.near)
    return {towards_robot + alternating(view.direction % kDirections) * o.overview_azimuth_step,
            o.overview_elevation, o.overview_distance};
  return {towards_robot + alternating(view.direction % kDirections) * o.near_azimuth_step, o.near_elevation,
          std::max(o.min_distance, o.near_distance - view.approach * o.near_step)};
}

/// How far a joint must turn to the nearest configuration that has the pose [rad]; none when it is out of
/// reach.
std::optional<double> pathCost(const Rigid3& base_from_tool0, const Puma560& arm,
                               const JointVector& current) {
  ArmSolutions solutions;
  arm.inverse(base_from_tool0, current, &solutions);

  std::optional<double> min_path;
  for (const ArmSolution& solution : solutions) {
    if (std::abs(std::sin(solution.joints[4])) < kMinWrist) continue;
    const double path = (solution.joints - current).cwiseAbs().maxCoeff();
    if (!min_path || path < *min_path) min_path = path;
  }
  return min_path;
}

}  // namespace

void CameraViewOptions::check() const {
  requirePositive("overview_distance", overview_distance);
  requirePositive("search_distance", search_distance);
  require(search_elevation > 0 && search_elevation <= M_PI / 2, "search_elevation", search_elevation,
          "above 0 and at most pi / 2");
  requirePositive("near_distance", near_distance);
  require(min_distance > 0 && min_distance <= near_distance, "min_distance", min_distance,
          "positive and at most near_distance");
  requireNotNegative("near_step", near_step);
  require(overview_elevation > 0 && overview_elevation <= M_PI / 2, "overview_elevation", overview_elevation,
          "above 0 and at most pi / 2");
  require(near_elevation > 0 && near_elevation <= M_PI / 2, "near_elevation", near_elevation,
          "above 0 and at most pi / 2");
  requireFinite("overview_azimuth_step", overview_azimuth_step);
  requireFinite("near_azimuth_step", near_azimuth_step);
  require(max_views >= 1, "max_views", max_views, "at least 1");
}

Eigen::Vector3d lookTarget(const TaskView& view, const std::optional<MappedObject>& frame,
                           const std::array<double, 3>& centre, const ModelBase& models) {
  const auto middleOf = [&](const MappedObject& object) -> Eigen::Vector3d {
    return object.base_from_object * models.objects.at(size_t(object.object)).model.centre();
  };
  if (view.near) return middleOf(view.object);
  if (frame) return middleOf(*frame);
  return Eigen::Map<const Eigen::Vector3d>(centre.data());
}

std::vector<Rigid3> cameraViews(const TaskView& view, const Eigen::Vector3d& target, const Puma560& arm,
                                const Rigid3& tool0_from_camera, const JointVector& current,
                                const CameraViewOptions& options) {
  options.check();
  if (!target.allFinite()) throw BadInput("the point to look at is not finite");
  const DesiredView desired = desiredView(view, target, options);
  const Rigid3 camera_from_tool0 = tool0_from_camera.inverse();

  struct Ranked {
    Rigid3 base_from_camera;
    double cost;
  };
  std::vector<Ranked> ranked;
  for (double turn : {0.0, 0.3, -0.3, 0.6, -0.6, 1.0, -1.0, 1.5, -1.5})
    for (double lift : {0.0, 0.15, -0.15, 0.3, -0.3})
      for (double nearer : {1.0, 0.88}) {
        const double elevation = desired.elevation + lift;
        const double distance = std::max(options.min_distance, nearer * desired.distance);
        if (elevation <= 0 || elevation >= M_PI / 2) continue;
        const double departure =
            std::abs(turn) * std::cos(elevation) + std::abs(lift) + (1 - distance / desired.distance);
        for (int k = 0; k < kRolls; ++k) {
          const Rigid3 pose =
              lookFrom(desired.azimuth + turn, elevation, distance, target, 2 * M_PI * k / kRolls);
          const std::optional<double> path = pathCost(pose * camera_from_tool0, arm, current);
          if (path) ranked.push_back({pose, departure + kJointWeight * *path});
        }
      }

  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
  std::vector<Rigid3> poses;
  for (const Ranked& r : ranked)
    if (int(poses.size()) < options.max_views) poses.push_back(r.base_from_camera);
  return poses;
}

}  // namespace monocular_eye_hand
