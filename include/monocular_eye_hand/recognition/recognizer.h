#pragma once
#include <memory>
#include <opencv2/core.hpp>

#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/recognition/object_estimate.h"
#include "monocular_eye_hand/recognition/options.h"

namespace monocular_eye_hand {

/// Recognises the known objects in single grey images: figure 2 of Wong et al. from end to end. Immutable
/// after construction; recognize() may be called from several threads.
class Recognizer {
 public:
  /// Throws BadInput when an option is out of range or the model base is empty.
  Recognizer(ModelBase models, RecognitionOptions options = {});
  ~Recognizer();
  const ModelBase& models() const;
  const RecognitionOptions& options() const;

  /// `grey`: CV_8UC1 of the camera's size. Throws BadInput on a bad image, a bad camera, or an unknown
  /// `only`.
  RecognitionResult recognize(const cv::Mat& grey, const Camera& camera,
                              const RecognitionRequest& request = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace monocular_eye_hand
