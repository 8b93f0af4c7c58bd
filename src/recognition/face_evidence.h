#pragma once
#include "monocular_eye_hand/model/object_model.h"
#include "recognition/candidate.h"
#include "recognition/search_image.h"

namespace monocular_eye_hand {

/// Looks at the pixels of the visible faces: edges that the model does not explain, departures from a smooth
/// shading, drawn area. Fills interior, through, print, off_face, shading, faces, solidity, size and
/// `covered`. The candidate's contour must be there.
void faceTerms(const ObjectModel& model, const SearchImage& image, Candidate* candidate);

}  // namespace monocular_eye_hand
