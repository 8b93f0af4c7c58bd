#pragma once
#include <vector>

#include "monocular_eye_hand/evaluation/causes.h"
#include "monocular_eye_hand/recognition/object_estimate.h"
#include "monocular_eye_hand/recognition/options.h"

namespace monocular_eye_hand {

/// Every candidate of RecognitionResult::judged in the terms of the data set, with what spoke against it.
/// `bop_objects`: ids of the model base's objects. `first`: how many poses stand before these in the list
/// that JudgedPose::suppressed_by counts in.
std::vector<JudgedPose> judgedPoses(const RecognitionResult& result, const std::vector<int>& bop_objects,
                                    const BopImage& image, int first);

/// The limits of the search for a data set whose images are resized by `scale`.
SearchLimits searchLimits(const RecognitionOptions& options, double scale);

}  // namespace monocular_eye_hand
