#pragma once
#include "monocular_eye_hand/simulation/cell/layout.h"

namespace monocular_eye_hand {

/// Replaces the objects (and the look, when CellRandom::lights says so) by the arrangement that
/// options.random draws. Throws BadInput when no part can be held or the opening has no room.
void arrangeAtRandom(const std::vector<NamedMesh>& models, CellScene* cell);

}  // namespace monocular_eye_hand
