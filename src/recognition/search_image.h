#pragma once
#include <opencv2/core.hpp>

#include "monocular_eye_hand/features/features.h"
#include "recognition/evidence.h"

namespace monocular_eye_hand {

/// What verification looks at in one image.
struct VerificationContext {
  const Camera& camera;
  const RectDomain& domain;
  const FeatureSet& features;
  const EvidenceMap& map;
  const EdgeRaster& raster;
  const cv::Mat& grey;  ///< rectified, on the domain
  double noise = 1;     ///< gradient noise of the image [grey levels per px]
};

}  // namespace monocular_eye_hand
