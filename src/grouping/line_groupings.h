#pragma once
#include <vector>

#include "grouping/image_context.h"

namespace monocular_eye_hand {

std::vector<Grouping> edgeGroupings(const ImageContext& context, const EndMap& ends);
std::vector<Grouping> junctionGroupings(const ImageContext& context, const EndMap& ends);
std::vector<Grouping> tripletGroupings(const ImageContext& context, const EndMap& ends);
/// Chains, and the quads whose fourth side is missing (U chains with both far ends).
std::vector<Grouping> chainGroupings(const ImageContext& context, const EndMap& ends);
std::vector<Grouping> openQuadGroupings(const std::vector<Grouping>& chains);
std::vector<Grouping> closedQuadGroupings(const ImageContext& context, const EndMap& ends);

/// Sorts best first (ties by features) and keeps at most `limit`.
void keepBest(std::vector<Grouping>* groupings, int limit);

/// Is a, b, c, d the outline of a convex four-corner figure, and in which sense does it turn? 0: not convex,
/// +1: growing atan2(v, u), -1: the other way.
int turningSense(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                 const Eigen::Vector2d& d);

}  // namespace monocular_eye_hand
