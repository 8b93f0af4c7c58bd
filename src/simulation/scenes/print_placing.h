#pragma once
#include <vector>

#include "monocular_eye_hand/simulation/finish.h"
#include "simulation/scenes/planar_faces.h"
#include "simulation/scenes/print_art.h"

namespace monocular_eye_hand {

/// In what way a thing is printed on.
enum class PrintPlan {
  kMarked,     ///< a few words, labels or logos, on its larger faces or bent over an edge
  kPackaging,  ///< printed all over
  kWorn        ///< scratches and stains
};

/// Prints for a mesh, in its frame. `texel`: size of a picture element [m]; `ground`: albedo below.
std::vector<Print> drawPrints(const Mesh& mesh, PrintPlan plan, double texel, double ground,
                              Generator* random);

/// A picture of this size lying in the plane z = 0 of `object_from_print`.
Print makePrint(Art art, const Rigid3& object_from_print, double width, double height, double texel,
                double ground, Generator* random);

}  // namespace monocular_eye_hand
