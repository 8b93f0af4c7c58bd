#pragma once
#include "monocular_eye_hand/geometry/random.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// A thing that is not to be found, and how it stands on the table.
struct ClutterPiece {
  SceneObject object;
  Rigid3 table_from_object;
};

/// Simple solids: boxes, cylinders, cones, balls, sheets.
ClutterPiece simplePiece(Generator* random, double scale);
/// What lies about in a workshop: trays, angle sections, rings, tubes, stacked plates, screws, cables,
/// rulers, besides the simple solids. Without material.
ClutterPiece workshopPiece(Generator* random, double scale);

}  // namespace monocular_eye_hand
