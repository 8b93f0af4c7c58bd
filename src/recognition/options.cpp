#include "monocular_eye_hand/recognition/options.h"

#include <sstream>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

void require(bool holds, const char* field, double value, const char* rule) {
  if (holds) return;
  std::ostringstream text;
  text << "recognition options: " << field << " = " << value << " " << rule;
  throw BadInput(text.str());
}

}  // namespace

void RecognitionOptions::check() const {
  features.check();
  grouping.check();
  decision.check();

  require(min_distance > 0, "min_distance", min_distance, "must be positive [m]");
  require(max_distance > min_distance, "max_distance", max_distance, "must be larger than min_distance [m]");
  require(min_size >= 8, "min_size", min_size, "must be at least 8 px");
  require(min_in_frame > 0 && min_in_frame <= 1, "min_in_frame", min_in_frame, "must be in (0, 1]");

  require(search_width >= 160, "search_width", search_width, "must be at least 160 px");
  require(refined_per_object > 0, "refined_per_object", refined_per_object, "must be positive");
  require(verified_per_object > 0, "verified_per_object", verified_per_object, "must be positive");
  require(thorough_models > 0, "thorough_models", thorough_models, "must be positive");
  require(rest_log_odds >= 0, "rest_log_odds", rest_log_odds, "must not be negative");
  require(budget >= 0, "budget", budget, "must not be negative (0 = no limit)");
  require(time_limit >= 0, "time_limit", time_limit, "must not be negative (0 = no limit) [s]");
  require(threads >= 0, "threads", threads, "must not be negative (0 = all cores but one)");

  require(accept_probability > 0 && accept_probability < 1, "accept_probability", accept_probability,
          "must be in (0, 1)");
  require(ambiguous_ratio > 0 && ambiguous_ratio <= 1, "ambiguous_ratio", ambiguous_ratio,
          "must be in (0, 1]");
}

}  // namespace monocular_eye_hand
