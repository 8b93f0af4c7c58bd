#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/evaluation/error_meter.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// Every candidate that the recogniser judged, with its distance from the truth: the material that the
/// decision's probabilities are fitted to.
class CandidateDump {
 public:
  explicit CandidateDump(const BopModels& models) : meter_(models, 0.05) {}
  void add(const BopImage& image, const ObjectEstimate& candidate, int bop_object);
  /// CSV: one line per candidate, the evidence terms as columns in alphabetical order, empty where a
  /// candidate lacks one. gt_id, mspd_px, mssd_d and visib belong to the nearest (MSPD) truth of the same
  /// object, empty without one.
  void write(const std::string& path) const;

 private:
  struct Row {
    int scene = 0, image = 0, bop_object = 0;
    ObjectEstimate candidate;
    int truth = -1;
    PoseErrors errors;
    double visible = 0;
  };
  ErrorMeter meter_;
  std::vector<Row> rows_;
};

}  // namespace monocular_eye_hand
