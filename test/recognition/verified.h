#pragma once
#include "recognition/verification.h"
#include "world.h"

namespace monocular_eye_hand {

/// What verification looks at in a picture.
inline SearchImage looked(const cv::Mat& grey, const Camera& camera) {
  return withEvidence(withFeatures(grey, camera, {}));
}

/// The candidate of a pose, verified.
inline Candidate verified(const SearchImage& image, const SearchModel& model, const Rigid3& pose) {
  Candidate candidate;
  candidate.pose.camera_from_object = model.canonical(pose, &candidate.view);
  verify(model, image, &candidate);
  return candidate;
}

}  // namespace monocular_eye_hand
