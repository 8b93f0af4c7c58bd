#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/evaluation/error_meter.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// Every candidate that the recogniser judged, suppressed ones too, with its distance from the truth: the
/// material that the decision's probabilities are fitted to and that other choices are tried on.
class CandidateDump {
 public:
  explicit CandidateDump(const BopModels& models) : meter_(models, 0.05) {}
  /// `candidates`: RecognitionResult::judged of the image; `bop_objects`: ids of the model base's objects.
  void add(const BopImage& image, const std::vector<JudgedCandidate>& candidates,
           const std::vector<int>& bop_objects);
  /// CSV: one line per candidate, the evidence terms as columns in alphabetical order, empty where a
  /// candidate lacks one. gt_id, mspd_px, mssd_d and visib belong to the nearest (MSPD) truth of the same
  /// object, empty without one; decision is empty of a suppressed candidate, suppressed_by of a chosen one.
  /// candidate is the index in its image, to which suppressed_by and conflicts (separated by spaces) refer;
  /// r11 ... r33 and t1 ... t3 [m] are camera_from_object.
  void write(const std::string& path) const;

 private:
  struct Row {
    int scene = 0, image = 0, bop_object = 0;
    int index = 0;  // in the image
    JudgedCandidate candidate;
    int truth = -1;
    PoseErrors errors;
    double visible = 0;
  };
  Row measured(const BopImage& image, const JudgedCandidate& candidate, int bop_object) const;

  ErrorMeter meter_;
  std::vector<Row> rows_;
};

}  // namespace monocular_eye_hand
