#pragma once
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

/// Adds a warning to every pair of models whose edges and circles agree in number and size: in the same size
/// (one is taken for the other) or scaled (only the distance tells them apart).
void warnAboutSimilarModels(ModelBase* base);

}  // namespace monocular_eye_hand
