#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// What came out of one image.
struct ImageReport {
  std::string image;  ///< path
  std::string error;  ///< why it could not be processed; "" when it was
  double seconds = 0;
  RecognitionResult result;
};

/// For people: a line about the image, then one per object (name, x y z in mm, roll pitch yaw in degrees
/// about fixed axes, probability, decision, symmetry), or why there is none.
std::string table(const ImageReport& report);

/// For programs: an entry of "images" in docs/json.md.
nlohmann::ordered_json toJson(const ImageReport& report, const ModelBase& models);

}  // namespace monocular_eye_hand
