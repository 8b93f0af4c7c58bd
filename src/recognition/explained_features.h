#pragma once
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// A flag per edge point: a drawn contour explains it. `claimed`: the points that answer a sample of the
/// contour (Candidate::claimed); a sample answers for the points up to half a step to either side of it, too.
std::vector<char> explainedPoints(const FeatureSet& features, const std::vector<int>& claimed);

/// Whether most edge points of a segment are explained. `explained`: as explainedPoints().
bool isExplained(const LineSegment& segment, const std::vector<char>& explained);

/// The same of an ellipse of the set: of the points of all its arcs.
bool isExplained(const FeatureSet& features, const DetectedEllipse& ellipse,
                 const std::vector<char>& explained);

}  // namespace monocular_eye_hand
