#pragma once
#include "model/build_model.h"
#include "recognition/verification.h"
#include "world.h"

namespace monocular_eye_hand {

/// What verification looks at in a picture.
inline SearchImage looked(const cv::Mat& grey, const Camera& camera) {
  return withEvidence(withFeatures(grey, camera, {}));
}

/// A part made for a test, as one of a model base.
inline KnownObject known(const std::string& name, const Mesh& mesh) {
  KnownObject object;
  object.model = buildModel(name, mesh);
  object.views = sampleViews(object.model, {});
  return object;
}

/// The candidate of a pose, verified.
inline Candidate verified(const SearchImage& image, const SearchModel& model, const Rigid3& pose) {
  Candidate candidate;
  candidate.pose.camera_from_object = model.canonical(pose, &candidate.view);
  verify(model, image, &candidate);
  return candidate;
}

}  // namespace monocular_eye_hand
