#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"

// Cameras of tests. A test that needs other numbers writes them down where it uses them.
namespace monocular_eye_hand {

/// Square pixels, the principal point in the middle of the image, no distortion. Focal length [px].
inline Camera centredCamera(int width, int height, double focal) {
  return {width, height, focal, focal, (width - 1) / 2.0, (height - 1) / 2.0, DistortionModel::kNone, {}};
}

/// Nothing in it is symmetric: pixels are not square, and the principal point is off the middle.
inline Camera unevenCamera() { return {640, 480, 600, 605, 322, 236, DistortionModel::kNone, {}}; }

/// The same camera through a lens, which is named as in ROS.
inline Camera withLens(Camera camera, const std::string& model, const std::vector<double>& coefficients) {
  setDistortion(&camera, model, coefficients.data(), coefficients.size());
  return camera;
}

/// The same camera through a lens that bends lines as a webcam does.
inline Camera withWebcamLens(const Camera& camera) {
  return withLens(camera, "plumb_bob", {-0.28, 0.08, 0.001, -0.0005, 0});
}

}  // namespace monocular_eye_hand
