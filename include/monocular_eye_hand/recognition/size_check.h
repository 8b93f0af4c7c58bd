#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/recognition/options.h"

namespace monocular_eye_hand {

/// Warnings "NAME: ..." about objects that this camera cannot see as the options want it anywhere between
/// min_distance and max_distance: too small even at the nearest (below min_size), or larger than the image
/// even at the farthest. Most often the unit of the mesh is wrong. The text names the limit and what to do.
std::vector<std::string> sizeWarnings(const ModelBase& models, const Camera& camera,
                                      const RecognitionOptions& options);

}  // namespace monocular_eye_hand
