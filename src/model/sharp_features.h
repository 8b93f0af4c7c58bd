#pragma once
#include "model/surfaces.h"

namespace monocular_eye_hand {

// Of an arc in a mesh: the widest of its edges, a little over 2 pi / 12, and the least that it covers [rad].
constexpr double kLargestSegment = 0.54;
constexpr double kSmallestSweep = 0.1;

struct SharpFeatures {
  std::vector<ModelEdge> edges;
  std::vector<ModelCircle> circles;
  std::vector<ModelCorner> corners;
};

/// Joins the sharp edges of the mesh into chains between the same two surfaces, and splits every chain into
/// straight edges and circular arcs. A run of at least three mesh edges is an arc when all its vertices lie
/// on one circle and none of its edges covers more than 31 degrees (a hexagon's edges cover 60).
SharpFeatures findSharpFeatures(const Mesh& mesh, const Topology& topology, const SurfaceSplit& split,
                                double tolerance);

}  // namespace monocular_eye_hand
