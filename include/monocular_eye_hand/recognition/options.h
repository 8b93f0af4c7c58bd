#pragma once
#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/grouping/grouping.h"

namespace monocular_eye_hand {

/// Defaults stand here and nowhere else. Every field is a key of config/recognizer.yaml.
struct RecognitionOptions {
  FeatureOptions features;
  GroupingOptions grouping;
  double min_distance = 0.25;     ///< nearest object centre considered [m]
  double max_distance = 2.5;      ///< farthest object centre considered [m]
  double min_size = 32.0;         ///< smallest image of an object's diameter considered [px]
  double min_in_frame = 0.4;      ///< smallest share of an object's contour inside the image
  int budget = 0;                 ///< most hypotheses scored per image; 0 = until all groupings are used
  double time_limit = 0;          ///< wall-clock cut [s]; 0 = none. A result it cuts says truncated.
  double accept_probability = 0.5;
  double ambiguous_ratio = 0.5;   ///< an alternative this likely relative to the best makes a result ambiguous

  void check() const;  ///< throws BadInput naming field, value and rule
};

}  // namespace monocular_eye_hand
