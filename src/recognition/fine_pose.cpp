#include "recognition/fine_pose.h"

#include <algorithm>
#include <optional>

#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/model/equal_poses.h"
#include "recognition/alignment.h"
#include "recognition/shared_work.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMaxMove =
    8.0;  // a pose that refinement moves farther is another one [px of the search image]

// `scale`: of the image over the search image, in which the candidate's pose was found.
FinePose refined(const SearchModel& model, const SearchImage& image, double scale, const RefinedPose& found) {
  Rigid3 pose = found.camera_from_object;
  if (scale > 1) {
    const RefinedPose aligned = alignFinely(model, image, pose, {1.5 * scale, scale, 1.5}, kFineStep * scale);
    if (aligned.well_posed) pose = aligned.camera_from_object;
  }

  const RefinedPose fine = alignByFeatures(model, image, pose, kFineRanges.back(), kFineStep);
  const double moved = model.poseDistance(image.camera, fine.camera_from_object, found.camera_from_object);
  if (!fine.well_posed || moved > kMaxMove * scale) return {found.camera_from_object, found.covariance};
  return {fine.camera_from_object, fine.covariance};
}

FinePose keptEqual(const ObjectModel& model, int object, const FinePose& pose,
                   const std::vector<ObjectEstimate>& previous) {
  const Rigid3& now = pose.camera_from_object;
  const auto old = std::find_if(previous.begin(), previous.end(), [&](const ObjectEstimate& o) {
    return o.object == object && (o.camera_from_object.translation - now.translation).norm() < model.diameter;
  });
  if (old == previous.end()) return pose;

  const Rigid3 equal = nearestEqualPose(model, now, old->camera_from_object);
  return {equal, propagate(adjointOfTranslation(equal.translation - now.translation), pose.covariance)};
}

}  // namespace

std::vector<FinePose> refineChosen(const SearchTask& task, const std::vector<Candidate>& candidates,
                                   const std::vector<Explanation>& chosen, const cv::Mat& grey,
                                   const Camera& camera, StageLog* log) {
  if (chosen.empty()) return {};
  const double scale = double(camera.width) / task.image.camera.width;

  return log->timed("fine poses", [&](StageReport* report) {
    std::optional<SearchImage> full;
    if (scale > 1) {
      full = withFeatures(grey, camera, task.options.features);
      report->counts = {{"edge points", double(full->features.points.size())}};
    }

    std::vector<FinePose> poses(chosen.size());
    atOnce(int(chosen.size()), [&](int i) {
      const Candidate& candidate = candidates[chosen[size_t(i)].candidate];
      poses[size_t(i)] =
          refined(task.models[candidate.object], full ? *full : task.image, scale, candidate.pose);
    });
    return poses;
  });
}

std::vector<FinePose> keepEqualPoses(const SearchTask& task, const std::vector<Candidate>& candidates,
                                     const std::vector<Explanation>& chosen, std::vector<FinePose> poses,
                                     const std::vector<ObjectEstimate>& previous) {
  for (size_t i = 0; i < chosen.size(); ++i) {
    const int object = candidates[chosen[i].candidate].object;
    poses[i] = keptEqual(task.models[object].model(), object, poses[i], previous);
  }
  return poses;
}

}  // namespace monocular_eye_hand
