#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "recognition/candidate.h"
#include "recognition/decision.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"

namespace monocular_eye_hand {

/// Candidates, and the image that they are seen in.
struct FullSize {
  SearchImage image;
  std::vector<Candidate> candidates;
};

/// A large image is searched at half its size or less, but what tells right from wrong is often seen only in
/// full: the likeliest candidates, and the first rivals of each, are moved onto the edges of the full image
/// and verified there. Nothing when the search image is the full one, or resolves the contours better because
/// the full one is blurred. `grey`, `camera`: the full image.
std::optional<FullSize> judgeInFull(const SearchTask& task, const ModelBase& base,
                                    const std::vector<Candidate>& candidates,
                                    const std::vector<Explanation>& chosen, const cv::Mat& grey,
                                    const Camera& camera, StageLog* log);

}  // namespace monocular_eye_hand
