#pragma once
#include "recognition/candidate.h"
#include "recognition/search_image.h"
#include "recognition/search_model.h"

namespace monocular_eye_hand {

/// Fills contour, claimed, covered and terms for the candidate's pose.
void verify(const SearchModel& model, const SearchImage& image, Candidate* candidate);

}  // namespace monocular_eye_hand
