#pragma once
#include <vector>

#include "monocular_eye_hand/drawing/overlays.h"
#include "monocular_eye_hand/evaluation/lens.h"

namespace monocular_eye_hand {

/// A model as it lies in the image.
struct Outline {
  const ObjectModel* model = nullptr;
  Rigid3 camera_from_object;
  Colour colour;
};

/// Two crops side by side around the first outline: as the camera saw it, and with the outlines, the first
/// one on top. The others are in the crop when they touch the first one's surroundings. Throws BadInput as
/// Canvas does.
cv::Mat casePicture(const CameraImage& image, const std::vector<Outline>& outlines);

}  // namespace monocular_eye_hand
