#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/evaluation/breakdown.h"
#include "monocular_eye_hand/evaluation/causes.h"
#include "monocular_eye_hand/evaluation/lens.h"
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

/// A run of the recogniser over a split, judged, with what the pages draw. Results, poses and truth in the
/// data set's pixels and frames.
struct EvaluatedRun {
  std::string title;               ///< "workcell dev"
  std::vector<std::string> notes;  ///< paragraphs under it: what was run, with which options
  const BopSplit& split;
  const BopModels& models;
  const ModelBase& known;  ///< object k is the k-th of `models`
  RunOutcomes outcomes;    ///< of what was reported
  ImageTimes times;
  std::vector<JudgedPose> judged;   ///< as measured() gave them; empty: only what was reported is known
  std::vector<TracedTruth> traced;  ///< how near the search came to wanted instances, as far as that is known
  SearchLimits limits;
  /// The image and camera that recognition was given. Throws BadInput when there is none: the pages say so.
  std::function<CameraImage(const BopImage&)> load;
};

/// Another run over the same split.
struct OtherRun {
  std::string name;
  RunOutcomes outcomes;
  ImageTimes times;
};

struct EvaluationPageOptions {
  int cases = 12;  ///< most missed and most wrong objects shown with a picture, each

  void check() const;  ///< throws BadInput naming field, value and rule
};

/// Writes FOLDER/index.html: scores by scene and part, recall against visibility, size, distance and side,
/// reliability and precision over recall, the worst cases as pictures, and with `other` what changed from it
/// to this run. Self-contained: no script, nothing fetched from elsewhere; all text escaped. Creates the
/// folder; overwrites its own files. Returns the path of the page. Throws BadInput when it cannot be written.
std::string writeEvaluationPage(const std::string& folder, const EvaluatedRun& run,
                                const std::optional<OtherRun>& other = {},
                                const EvaluationPageOptions& options = {});

/// Writes FOLDER/index.html: every missed and every wrong object with a picture and why, the causes with
/// their counts at the top. Otherwise as writeEvaluationPage().
std::string writeMissesPage(const std::string& folder, const EvaluatedRun& run);

}  // namespace monocular_eye_hand
