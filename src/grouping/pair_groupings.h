#pragma once
#include <vector>

#include "grouping/image_context.h"

namespace monocular_eye_hand {

/// `edges`: the kEdge grouping of each segment, in the order of the segments.
std::vector<Grouping> parallelGroupings(const ImageContext& context, const std::vector<Grouping>& edges);
std::vector<Grouping> ellipseGroupings(const ImageContext& context);
std::vector<Grouping> ellipsePairGroupings(const ImageContext& context);
std::vector<Grouping> ellipseLineGroupings(const ImageContext& context, const std::vector<Grouping>& edges);

}  // namespace monocular_eye_hand
