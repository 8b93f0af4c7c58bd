#pragma once
#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/simulation/render/rendered_image.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// Ray casting (Embree): pixel centres at integer coordinates, box pixel filter, lens distortion by
/// Camera::undistort. Same arguments, same picture. 640x480 with default options takes below a second on one
/// core. Throws BadInput on a camera that fails Camera::check(), an object without triangles, or options out
/// of range.
RenderedImage renderScene(const Scene& scene, const Camera& camera, const RenderOptions& options = {});

}  // namespace monocular_eye_hand
