#pragma once
#include <vector>

#include "monocular_eye_hand/grouping/grouping.h"
#include "monocular_eye_hand/pose/matches.h"
#include "recognition/candidate.h"
#include "recognition/search_model.h"

namespace monocular_eye_hand {

/// A corner of the image: where the lines of an L, a triplet, a chain or a quad meet.
struct ImageCorner {
  Eigen::Vector2d uv;
  double sigma = 1;           ///< [px]
  std::vector<int> segments;  ///< FeatureSet::segments that meet there
};

/// The corners of all groupings; those closer than a pixel and a half are one, the most certain kept.
std::vector<ImageCorner> imageCorners(const std::vector<Grouping>& groupings);

/// Constellation matching: the largest set of model corners and image corners that agree with the candidate's
/// pose, in place and in the directions of the edges that meet there. One image corner serves one model
/// corner.
std::vector<PointMatch> growConstellation(const SearchModel& model, const Candidate& candidate,
                                          const Camera& camera, const FeatureSet& features,
                                          const std::vector<ImageCorner>& corners);

}  // namespace monocular_eye_hand
