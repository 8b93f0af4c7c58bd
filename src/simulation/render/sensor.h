#pragma once
#include "monocular_eye_hand/simulation/render/rendered_image.h"

namespace monocular_eye_hand {

/// As a camera's automatic: the wanted mean, but bright parts keep their shading (only this share, by
/// default the brightest 0.5 %, may saturate).
double automaticExposure(const cv::Mat1f& light, double mean, double saturated = 0.005);

/// Gaussian of the lens; sigma in pixels, 0: as it is.
cv::Mat1f blurred(const cv::Mat1f& radiance, double sigma);

/// Lens blur, exposure, gamma, noise, 8 bits.
cv::Mat sensorImage(const cv::Mat1f& radiance, const RenderOptions& options, double* exposure);

}  // namespace monocular_eye_hand
