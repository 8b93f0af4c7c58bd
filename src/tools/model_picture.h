#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// A shaded view of the model with its visible features: straight edges yellow, circles and arcs magenta,
/// silhouettes of curved surfaces cyan, corners as dots, a symmetry axis as a green line; `text` down the
/// left side. CV_8UC3.
cv::Mat modelPicture(const ObjectModel& model, const std::vector<std::string>& text);

}  // namespace monocular_eye_hand
