#pragma once
#include "model/sharp_features.h"

namespace monocular_eye_hand {

/// Of a rounded edge that still looks like one: the width of its wall or band along the arc, at most this
/// share of the diameter.
constexpr double kWidestRound = 0.12;

/// Edges that a fillet or a round took the sharpness from: where a narrow cylinder wall joins two planes
/// smoothly, an image shows an edge, somewhere on the wall. p and q lie along its middle.
std::vector<ModelEdge> findRoundedEdges(const Mesh& mesh, const Topology& topology, const SurfaceSplit& split,
                                        double diameter);

/// Adds rounded edges, and corners where their lines meet.
void addRoundedEdges(const std::vector<ModelEdge>& rounded, SharpFeatures* features);

}  // namespace monocular_eye_hand
