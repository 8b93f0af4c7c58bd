#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// A rotation that leaves nearly all of the surface where it is.
struct NearSymmetry {
  Rigid3 motion;
  double differing = 0;  ///< share of the surface that it moves off itself
};

struct SymmetryResult {
  Symmetries symmetries;
  std::vector<NearSymmetry> twins;  ///< of the nearest kinds only; empty with a continuous axis
};

/// Symmetries derived from the geometry. Every symmetry fixes the centroid of the surface and permutes equal
/// features: candidates map one pair of features (corners, edge middles, circle centres, else vertices) to
/// every pair like it, or turn by half about the principal axes; circle and cylinder axes and the principal
/// axes are candidates for a continuous axis. A candidate holds when no sample of the turned surface is
/// farther from the surface than `tolerance` [m]; samples of both directions are compared. On fitted full
/// circles and cylinders, and on bodies of revolution, what their polygons make up is allowed besides
/// (tessellation.h). Those that hold and whose products hold make the group that is found: it is closed to
/// machine precision. Rotations only: a mirror image is another part.
SymmetryResult findSymmetries(const ObjectModel& model, double tolerance);

}  // namespace monocular_eye_hand
