#pragma once
#include <string>

#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// Welds, finds surfaces, sharp edges, circles, corners, symmetries; fills warnings. Throws BadInput on an
/// empty mesh.
ObjectModel buildModel(const std::string& name, const Mesh& mesh, const ModelOptions& options = {});

}  // namespace monocular_eye_hand
