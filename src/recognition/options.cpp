#include "monocular_eye_hand/recognition/options.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void RecognitionOptions::check() const {
  features.check();
  grouping.check();
  decision.check();

  requirePositive("min_distance", min_distance);
  require(max_distance > min_distance, "max_distance", max_distance, "larger than min_distance [m]");
  require(min_size >= 8, "min_size", min_size, "at least 8 px");
  require(min_in_frame > 0 && min_in_frame <= 1, "min_in_frame", min_in_frame, "in (0, 1]");

  require(search_width >= 160, "search_width", search_width, "at least 160 px");
  requirePositive("refined_per_object", refined_per_object);
  requirePositive("verified_per_object", verified_per_object);
  requirePositive("thorough_models", thorough_models);
  requireNotNegative("rest_log_odds", rest_log_odds);
  require(budget >= 0, "budget", budget, "0 or more (0 = no limit)");
  require(time_limit >= 0, "time_limit", time_limit, "0 or more (0 = no limit) [s]");
  require(threads >= 0, "threads", threads, "0 or more (0 = all cores but one)");

  require(accept_probability > 0 && accept_probability < 1, "accept_probability", accept_probability,
          "in (0, 1)");
  require(ambiguous_ratio > 0 && ambiguous_ratio <= 1, "ambiguous_ratio", ambiguous_ratio, "in (0, 1]");
}

}  // namespace monocular_eye_hand
