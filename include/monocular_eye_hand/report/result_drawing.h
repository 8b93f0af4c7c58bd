#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "monocular_eye_hand/drawing/overlays.h"
#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

// Pictures of a RecognitionResult. A room of its own because drawing/ lies below recognition/.

/// Accepted green, ambiguous amber, rejected red.
Colour decisionColour(Decision decision);
/// "bridge 0.97".
std::string objectLabel(const ObjectEstimate& object);

/// All accepted and ambiguous objects over the image, coloured by decision; rejected candidates too when
/// asked. `camera`: of `grey`. Throws BadInput when they do not fit together or an object index is not in
/// `models`.
cv::Mat drawResult(const cv::Mat& grey, const Camera& camera, const ModelBase& models,
                   const RecognitionResult& result, bool with_rejected = false, const PictureSize& size = {});
/// One picture per accepted or ambiguous object, in the order of RecognitionResult::objects (figure 11
/// of Wong et al.).
std::vector<cv::Mat> drawBackProjections(const cv::Mat& grey, const Camera& camera, const ModelBase& models,
                                         const RecognitionResult& result);
/// One candidate alone over the image.
cv::Mat drawCandidate(const cv::Mat& grey, const Camera& camera, const ModelBase& models,
                      const ObjectEstimate& candidate);

}  // namespace monocular_eye_hand
