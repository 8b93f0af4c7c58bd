#pragma once
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "recognition/candidate.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"
#include "recognition/work_budget.h"

namespace monocular_eye_hand {

/// Candidates, and the image that they are seen in.
struct ImageLevel {
  SearchImage image;
  std::vector<Candidate> candidates;
};

/// Searches an image, knowing candidates from another size of it; all candidates.
using SearchLevel = std::function<std::vector<Candidate>(const SearchTask&, std::vector<Candidate> known)>;

/// A large image is searched at half its size or less; this goes on from there, each time to twice the size.
/// What tells right from wrong is often seen only in a larger image: the likeliest candidates, and the first
/// rivals of each, are moved onto its edges and verified there. Parts that the smaller one showed too small
/// are searched for by `search`, which may be empty. It ends with the full image, where the candidates are
/// resolved and no part can be too small, or where the larger image says less because it is blurred. Nothing
/// when that is the image of the task. `base`: the models that groupings are made for; `grey`, `camera`: the
/// full image.
std::optional<ImageLevel> lookFiner(const SearchTask& task, const ModelBase& base,
                                    const std::vector<Candidate>& candidates, const cv::Mat& grey,
                                    const Camera& camera, const SearchLevel& search, StageLog* log);

}  // namespace monocular_eye_hand
