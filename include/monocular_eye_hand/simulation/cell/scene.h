#pragma once
#include <vector>

#include "monocular_eye_hand/simulation/cell/layout.h"
#include "monocular_eye_hand/simulation/cell/options.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// Puts the objects of `options` (or with random.seed >= 0 a random arrangement) on the table. An object
/// whose pose is less than 1 mm off resting is set down on the table. Throws BadInput when the model base
/// lacks a named object or an object sinks into the table, and when a random arrangement finds no room.
CellScene makeCellScene(const CellOptions& options, const std::vector<NamedMesh>& models);

}  // namespace monocular_eye_hand
