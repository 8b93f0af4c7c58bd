#pragma once
#include "monocular_eye_hand/simulation/render.h"

namespace monocular_eye_hand {

/// Lens blur, exposure, gamma, noise, 8 bits.
cv::Mat sensorImage(const cv::Mat1f& radiance, const RenderOptions& options, double* exposure);

}  // namespace monocular_eye_hand
