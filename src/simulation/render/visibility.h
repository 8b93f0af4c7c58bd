#pragma once
#include "monocular_eye_hand/simulation/render/rendered_image.h"
#include "simulation/render/ray_world.h"

namespace monocular_eye_hand {

/// BOP's visible fraction of every object, given the id map. The part of an object outside the image counts
/// as hidden, as far as one image size beyond the border.
std::vector<Visibility> visibility(const Scene& scene, const RayWorld& world, const Camera& camera,
                                   const cv::Mat& ids);

}  // namespace monocular_eye_hand
