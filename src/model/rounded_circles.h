#pragma once
#include "model/surfaces.h"

namespace monocular_eye_hand {

/// Rims and shoulders that a fillet or a round took the sharpness from: where a narrow band (a piece of a
/// torus) joins a plane and a cylinder wall that stands on it smoothly, an image shows a circle or an arc,
/// somewhere on the band. The circle lies along the band's middle; surface[0] is the plane.
std::vector<ModelCircle> findRoundedCircles(const Mesh& mesh, const Topology& topology,
                                            const SurfaceSplit& split, double diameter);

}  // namespace monocular_eye_hand
