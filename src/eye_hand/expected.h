#pragma once
#include <cstddef>
#include <vector>

#include "monocular_eye_hand/eye_hand/object_map_options.h"
#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// A known object at a place, for the question what a camera should see.
struct PlacedModel {
  const ObjectModel* model = nullptr;
  Rigid3 base_from_object;
};

/// Whether a camera should show objects[index]: large enough, neither too near nor too far, and a share of it
/// inside the image and not hidden by the others.
bool expectedInView(const std::vector<PlacedModel>& objects, size_t index, const Camera& camera,
                    const Rigid3& base_from_camera, const ObjectMapOptions& options);

}  // namespace monocular_eye_hand
