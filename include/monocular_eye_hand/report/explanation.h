#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

struct ExplanationOptions {
  std::string title = "How the image was understood";
  int rejected = 12;  ///< most rejected candidates shown with a picture

  void check() const;  ///< throws BadInput naming field, value and rule
};

/// Writes FOLDER/index.html and a picture per stage beside it: image, traces, segments, ellipses, groupings
/// per kind, candidates with the terms of their decision and why they were accepted or rejected, the result,
/// counts and times. Self-contained: no script, nothing fetched from elsewhere; all text escaped. Creates the
/// folder; overwrites its own files. `grey` and `camera` are what was given to recognize(); features and
/// groupings are shown at the resolution that was searched. Returns the path of the page. Throws BadInput
/// when the folder cannot be written or image and camera do not fit together.
std::string writeExplanation(const std::string& folder, const cv::Mat& grey, const Camera& camera,
                             const ModelBase& models, const RecognitionResult& result,
                             const ExplanationOptions& options = {});

/// The figures of the method's paper drawn for one image: FOLDER/figure_09_scene.png,
/// figure_10a_line_groups.png, figure_10b_ellipses.png, and per accepted or ambiguous object, best first, a
/// back-projection figure_11a_<name>.png, figure_11b_<name>.png, ... Creates the folder; figures of an
/// earlier call are replaced. Returns the paths. Throws BadInput as writeExplanation().
std::vector<std::string> writeFigures(const std::string& folder, const cv::Mat& grey, const Camera& camera,
                                      const ModelBase& models, const RecognitionResult& result);

/// The image at the size that was searched (RecognitionResult::features.camera): itself, or made smaller.
cv::Mat searchImage(const cv::Mat& grey, const Camera& searched);

}  // namespace monocular_eye_hand
