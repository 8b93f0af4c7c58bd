#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/simulation/render/rendered_image.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// One known object of a shipped picture.
struct TruthObject {
  std::string name;
  int model = -1;  ///< ModelBase index when the scene was made; names decide
  Rigid3 camera_from_object;
  double visible_fraction = 0;  ///< BOP's visib_fract
  cv::Rect box_visible;         ///< raw pixels
};

/// The known objects of a rendered scene (clutter is left out).
std::vector<TruthObject> truthOf(const Scene& scene, const RenderedImage& image);

/// JSON: {"objects": [{"name", "cam_R_m2c" (9 numbers, row by row), "cam_t_m2c" (mm), "visib_fract",
/// "bbox_visib"}]}, keys as in BOP's scene_gt. Throw BadInput naming the file.
void writeTruth(const std::string& path, const std::vector<TruthObject>& objects);
std::vector<TruthObject> readTruth(const std::string& path);

/// Writes the camera as loadCamera reads it. Throws BadInput when the file cannot be written.
void writeCamera(const std::string& path, const Camera& camera, const std::string& name = "camera");

}  // namespace monocular_eye_hand
