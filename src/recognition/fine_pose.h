#pragma once
#include <vector>

#include "monocular_eye_hand/recognition/object_estimate.h"
#include "recognition/candidate.h"
#include "recognition/decision.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"

namespace monocular_eye_hand {

/// A pose as it is reported.
struct FinePose {
  Rigid3 camera_from_object;
  Matrix6d covariance = Matrix6d::Zero();  ///< as ObjectEstimate::covariance
};

/// The poses of the chosen candidates, one per explanation, aligned to the edges of the full image and
/// refined feature against feature. `grey` and `camera`: the full image; it is looked at only when the search
/// image is smaller.
std::vector<FinePose> refineChosen(const SearchTask& task, const std::vector<Candidate>& candidates,
                                   const std::vector<Explanation>& chosen, const cv::Mat& grey,
                                   const Camera& camera, StageLog* log);

/// Of the poses that a part's symmetry makes equal, those nearest to where the objects were in the last
/// frame; a pose with no object of its kind near it in `previous` stays as it is. `poses`: one per
/// explanation.
std::vector<FinePose> keepEqualPoses(const SearchTask& task, const std::vector<Candidate>& candidates,
                                     const std::vector<Explanation>& chosen, std::vector<FinePose> poses,
                                     const std::vector<ObjectEstimate>& previous);

}  // namespace monocular_eye_hand
