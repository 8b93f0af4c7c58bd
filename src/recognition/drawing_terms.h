#pragma once
#include "recognition/candidate.h"
#include "recognition/search_image.h"
#include "recognition/search_model.h"

namespace monocular_eye_hand {

// Evidence terms that compare a candidate's drawn contour with the image, feature by feature. Each takes a
// candidate whose contour is matched to edge points and fills its own fields of EvidenceTerms.

/// How well the edge points that answer the drawing hang together as contours of one thing: different points
/// per answered sample, one gradient sign along a feature, neighbouring samples on one trace, contrast
/// against the edges around.
void coherenceTerms(const SearchImage& image, Candidate* candidate);

constexpr double kHitRange = 2.0;  ///< an edge this near answers a sample [px]
constexpr double kStep = 4.0;      ///< distance between contour samples [px]

/// How precisely the drawing lies on the edges: by chance they are spread over the whole range of search.
void precisionTerms(const SearchImage& image, Candidate* candidate);

/// What of the drawing is missing, told apart: outline or inner feature, and on flat ground (nothing is
/// there) or not (something else may hide it).
void absenceTerms(const ObjectModel& model, const SearchImage& image, Candidate* candidate);

/// How much of the drawing the same place would answer by chance: the drawing shifted by 11 and 19 px.
void chanceTerms(const SearchImage& image, Candidate* candidate);

/// Image edges that run on where the drawing ends: past the end of a model edge, past the claimed part of a
/// segment.
void runOnTerms(const ObjectModel& model, const SearchImage& image, Candidate* candidate);

/// Image edges that run through the outline: where the part lay over them they would end.
void crossingTerms(const SearchImage& image, Candidate* candidate);

/// How much of the part this view shows: area and extent over the largest of all views.
void viewTerms(const SearchModel& model, const SearchImage& image, Candidate* candidate);

}  // namespace monocular_eye_hand
