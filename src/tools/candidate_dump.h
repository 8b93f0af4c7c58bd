#pragma once
#include <map>
#include <string>
#include <utility>
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
  /// object, empty without one; adi_d (adi() over the diameter) is there for wrong poses in the truth's
  /// place, empty otherwise; decision is empty of a suppressed candidate, suppressed_by of a chosen one.
  /// candidate is the index in its image, to which suppressed_by, conflicts and contests (separated by
  /// spaces, contests as rival:log_odds:precise:contrast:strength:shading) refer; r11 ... r33 and t1 ... t3
  /// [m] are camera_from_object.
  void write(const std::string& path) const;

 private:
  struct Row {
    int scene = 0, image = 0, bop_object = 0;
    int index = 0;  // in the image
    JudgedCandidate candidate;
    int truth = -1;
    PoseErrors errors;
    double adi = -1;  // of a wrong one near the truth, share of the diameter
    double visible = 0;
  };
  Row measured(const BopImage& image, const JudgedCandidate& candidate, int bop_object) const;

  ErrorMeter meter_;
  std::vector<Row> rows_;
};

/// The poses of a dump, to be judged again.
class DumpedPoses {
 public:
  DumpedPoses() = default;
  /// Throws BadInput when the file is no dump.
  explicit DumpedPoses(const std::string& path);
  /// Those of an image. `bop_objects`: ids of the model base's objects; others are passed over.
  std::vector<PoseProposal> of(const BopImage& image, const std::vector<int>& bop_objects) const;

 private:
  std::map<std::pair<int, int>, std::vector<PoseProposal>> poses_;  // by scene and image; object: its BOP id
};

}  // namespace monocular_eye_hand
