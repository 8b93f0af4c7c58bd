#pragma once
#include "recognition/candidate.h"
#include "recognition/search_image.h"
#include "recognition/search_model.h"

namespace monocular_eye_hand {

/// Draws the candidate's contour on the image and fills contour, claimed, bounding box and the terms of the
/// contour alone: enough to turn down what the image hardly shows.
void drawContour(const SearchModel& model, const SearchImage& image, Candidate* candidate);
/// Fills the other terms and `covered` of a drawn candidate.
void weighDrawing(const SearchModel& model, const SearchImage& image, Candidate* candidate);
/// Both.
void verify(const SearchModel& model, const SearchImage& image, Candidate* candidate);

}  // namespace monocular_eye_hand
