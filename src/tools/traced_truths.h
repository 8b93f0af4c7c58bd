#pragma once
#include <vector>

#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/evaluation/lost_at.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// BopImage::truth of the wanted instances of the objects that are known. `bop_objects`: ids of the model
/// base's objects.
std::vector<int> wantedTruths(const BopImage& image, const std::vector<int>& bop_objects);

/// Their poses, for RecognitionRequest::traced.
std::vector<PoseProposal> posesToTrace(const BopImage& image, const std::vector<int>& truths,
                                       const std::vector<int>& bop_objects);

/// What RecognitionResult::traces says of them, in pixels of the data set. `scale`: of the image that
/// recognition was given over the image of the data set. Empty without traces.
std::vector<TracedTruth> tracedTruths(const std::vector<PoseTrace>& traces, const BopImage& image,
                                      const std::vector<int>& truths, double scale);

}  // namespace monocular_eye_hand
