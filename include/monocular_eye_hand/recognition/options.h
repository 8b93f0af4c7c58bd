#pragma once
#include <algorithm>

#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/grouping/grouping.h"
#include "monocular_eye_hand/recognition/decision_weights.h"

namespace monocular_eye_hand {

/// Defaults stand here and nowhere else. Every field is a key of config/recognizer.yaml.
struct RecognitionOptions {
  FeatureOptions features;
  GroupingOptions grouping;
  DecisionWeights decision = fittedWeights();
  double min_distance = 0.05;  ///< nearest object centre considered [m]; none nearer than its diameter
  double max_distance = 2.5;   ///< farthest object centre considered [m]
  double min_size = 32.0;      ///< smallest image of an object's diameter considered, in the full image [px]
  double min_in_frame = 0.4;   ///< smallest share of an object's contour inside the image
  int search_width = 960;      ///< wider images are searched smaller first (finer_levels.h) [px]
  int refined_per_object = 300;  ///< hypotheses moved onto the edges, per object and round
  int verified_per_object = 30;  ///< of these, refined on the exact contour and judged
  int thorough_models = 10;      ///< all of so many models are searched for to the end; of more, the half of
                                 ///< this number that is most promising at a first look
  int budget = 0;                ///< most hypotheses scored per image; 0 = until all groupings are used
  double time_limit = 0;         ///< wall-clock cut [s]; 0 = none. A result it cuts says truncated.
  int threads = 0;               ///< that share the work on one image, which has the same answer; 0 = one
                                 ///< for every core but one
  double accept_probability = 0.5;
  double rest_log_odds = 2.0;    ///< most that a pose gains which rests on a known support plane [log-odds]
  double ambiguous_ratio = 0.5;  ///< an alternative this likely relative to the best makes a result ambiguous

  template <class Visitor>
  void visit(Visitor&& v) {
    v("features", features);
    v("grouping", grouping);
    v("decision", decision);
    v("min_distance", min_distance);
    v("max_distance", max_distance);
    v("min_size", min_size);
    v("min_in_frame", min_in_frame);
    v("search_width", search_width);
    v("refined_per_object", refined_per_object);
    v("verified_per_object", verified_per_object);
    v("thorough_models", thorough_models);
    v("budget", budget);
    v("time_limit", time_limit);
    v("threads", threads);
    v("accept_probability", accept_probability);
    v("rest_log_odds", rest_log_odds);
    v("ambiguous_ratio", ambiguous_ratio);
  }
  /// Nearest distance at which an object of this diameter is considered [m].
  double nearest(double diameter) const { return std::max(min_distance, diameter); }
  void check() const;  ///< throws BadInput naming field, value and rule
};

}  // namespace monocular_eye_hand
