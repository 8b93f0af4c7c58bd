#pragma once
#include <opencv2/core.hpp>
#include <string>

#include "monocular_eye_hand/recognition/recognizer.h"

namespace monocular_eye_hand {

struct ExplanationOptions {
  std::string title = "How the image was understood";
  int rejected = 12;  ///< most rejected candidates shown with a picture

  void check() const;  ///< throws BadInput naming field, value and rule
};

/// Writes FOLDER/index.html and a picture per stage beside it: image, traces, segments, ellipses, groupings
/// per kind, candidates with the terms of their decision and why they were accepted or rejected, the result,
/// counts and times. Self-contained: no script, nothing fetched from elsewhere; all text escaped. Creates the
/// folder; overwrites its own files. The camera is RecognitionResult::features.camera. Returns the path of
/// the page. Throws BadInput when the folder cannot be written or image and camera do not fit together.
std::string writeExplanation(const std::string& folder, const cv::Mat& grey, const ModelBase& models,
                             const RecognitionResult& result, const ExplanationOptions& options = {});

/// Text for HTML: & < > " ' replaced; bytes that are not UTF-8 and control characters become U+FFFD.
std::string escapeHtml(const std::string& text);

}  // namespace monocular_eye_hand
