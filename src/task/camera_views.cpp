#include "monocular_eye_hand/task/camera_views.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/look_at.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

constexpr int kRolls = 12;
constexpr int kDirections = 5;         // then from the first one again
constexpr double kJointWeight = 0.25;  // of a joint's way against the departure from the wished direction
constexpr double kMinWrist = 0.05;     // |sin q5|: nearer to the singularity the arm cannot move on

struct Wish {
  double azimuth, elevation, distance;
};

/// 0, 1, -1, 2, -2, ...
int alternating(int i) { return i % 2 ? (i + 1) / 2 : -i / 2; }

Wish wishOf(const TaskView& view, const Eigen::Vector3d& target, const CameraViewOptions& o) {
  const double towards_robot = std::atan2(-target.y(), -target.x());
  if (view.search)
    return {towards_robot + alternating(view.direction % kDirections) * o.overview_azimuth_step,
            o.search_elevation, o.search_distance};
  if (!view.near)
    return {towards_robot + alternating(view.direction % kDirections) * o.overview_azimuth_step,
            o.overview_elevation, o.overview_distance};
  return {towards_robot + alternating(view.direction % kDirections) * o.near_azimuth_step, o.near_elevation,
          std::max(o.nearest, o.near_distance - view.approach * o.near_step)};
}

/// Largest way of a joint to the nearest posture; negative when the pose is out of reach.
double wayTo(const Rigid3& base_from_tool0, const Puma560& arm, const JointVector& current) {
  ArmSolutions solutions;
  arm.inverse(base_from_tool0, current, &solutions);
  double least = -1;
  for (const ArmSolution& solution : solutions) {
    if (std::abs(std::sin(solution.joints[4])) < kMinWrist) continue;
    const double way = (solution.joints - current).cwiseAbs().maxCoeff();
    if (least < 0 || way < least) least = way;
  }
  return least;
}

}  // namespace

void CameraViewOptions::check() const {
  requirePositive("overview_distance", overview_distance);
  requirePositive("search_distance", search_distance);
  require(search_elevation > 0 && search_elevation <= M_PI / 2, "search_elevation", search_elevation,
          "above 0 and at most pi / 2");
  requirePositive("near_distance", near_distance);
  require(nearest > 0 && nearest <= near_distance, "nearest", nearest, "positive and at most near_distance");
  requireNotNegative("near_step", near_step);
  require(overview_elevation > 0 && overview_elevation <= M_PI / 2, "overview_elevation", overview_elevation,
          "above 0 and at most pi / 2");
  require(near_elevation > 0 && near_elevation <= M_PI / 2, "near_elevation", near_elevation,
          "above 0 and at most pi / 2");
  requireFinite("overview_azimuth_step", overview_azimuth_step);
  requireFinite("near_azimuth_step", near_azimuth_step);
  require(most >= 1, "most", most, "at least 1");
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
  const Wish wish = wishOf(view, target, options);
  const Rigid3 camera_from_tool0 = tool0_from_camera.inverse();

  struct Ranked {
    Rigid3 base_from_camera;
    double cost;
  };
  std::vector<Ranked> ranked;
  for (double turn : {0.0, 0.3, -0.3, 0.6, -0.6, 1.0, -1.0, 1.5, -1.5})
    for (double lift : {0.0, 0.15, -0.15, 0.3, -0.3})
      for (double nearer : {1.0, 0.88}) {
        const double elevation = wish.elevation + lift;
        const double distance = std::max(options.nearest, nearer * wish.distance);
        if (elevation <= 0 || elevation >= M_PI / 2) continue;
        const double departure =
            std::abs(turn) * std::cos(elevation) + std::abs(lift) + (1 - distance / wish.distance);
        for (int k = 0; k < kRolls; ++k) {
          const Rigid3 pose =
              lookFrom(wish.azimuth + turn, elevation, distance, target, 2 * M_PI * k / kRolls);
          const double way = wayTo(pose * camera_from_tool0, arm, current);
          if (way >= 0) ranked.push_back({pose, departure + kJointWeight * way});
        }
      }

  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Ranked& a, const Ranked& b) { return a.cost < b.cost; });
  std::vector<Rigid3> poses;
  for (const Ranked& r : ranked)
    if (int(poses.size()) < options.most) poses.push_back(r.base_from_camera);
  return poses;
}

}  // namespace monocular_eye_hand
