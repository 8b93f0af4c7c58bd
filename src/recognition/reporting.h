#pragma once
#include <vector>

#include "monocular_eye_hand/recognition/object_estimate.h"
#include "monocular_eye_hand/recognition/options.h"
#include "recognition/decision.h"
#include "recognition/search_model.h"

namespace monocular_eye_hand {

/// Turns a chosen candidate into the object that is reported: decision with reason, alternatives,
/// plausibility, reliability, symmetry. `rivals`: the candidates that explain the same part of the image.
ObjectEstimate reportObject(const std::vector<SearchModel>& models, const std::vector<Candidate>& candidates,
                            const Explanation& explanation, const RecognitionOptions& options,
                            const Camera& camera, const std::vector<Grouping>& groupings,
                            const FeatureSet& features);

/// For people: "", "2 equal poses", "free about the axis (0, 0, 1) through (0, 0, 0) m".
std::string describeSymmetry(const Symmetries& symmetries);

}  // namespace monocular_eye_hand
