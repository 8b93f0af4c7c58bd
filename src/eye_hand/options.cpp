#include <cmath>
#include <sstream>

#include "monocular_eye_hand/eye_hand/object_map_options.h"
#include "monocular_eye_hand/eye_hand/object_view.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

void require(bool good, const char* field, double value, const char* rule) {
  if (good && std::isfinite(value)) return;
  std::ostringstream text;
  text << field << " = " << value << " must be " << rule;
  throw BadInput(text.str());
}
void requirePositive(const char* field, double value) { require(value > 0, field, value, "above 0"); }
void requireShare(const char* field, double value) {
  require(value >= 0 && value <= 1, field, value, "between 0 and 1");
}

}  // namespace

void ObjectMapOptions::check() const {
  arm.check();
  hand_eye.check();

  requireShare("min_probability", min_probability);
  requirePositive("floor_position", floor_position);
  requirePositive("floor_rotation", floor_rotation);
  requirePositive("gate", gate);
  requirePositive("same_place", same_place);
  require(max_distance >= 0, "max_distance", max_distance, "0 or more");

  require(outliers_to_restart >= 1, "outliers_to_restart", outliers_to_restart, "1 or more");
  require(min_motion >= 0, "min_motion", min_motion, "0 or more");
  require(min_turn >= 0, "min_turn", min_turn, "0 or more");
  require(most_views >= 1, "most_views", most_views, "1 or more");
  requirePositive("overlap_depth", overlap_depth);
  require(known_depth >= 0, "known_depth", known_depth, "0 or more");
  require(known_sigmas >= 0, "known_sigmas", known_sigmas, "0 or more");
  require(forget_after_misses >= 1, "forget_after_misses", forget_after_misses, "1 or more");

  requireShare("expected_share", expected_share);
  require(expected_size >= 0, "expected_size", expected_size, "0 or more");
  require(expected_border >= 0, "expected_border", expected_border, "0 or more");
  require(expected_nearest >= 0, "expected_nearest", expected_nearest, "0 or more");
  require(expected_farthest > expected_nearest, "expected_farthest", expected_farthest,
          "above expected_nearest");
}

std::string toString(ViewOutcome outcome) {
  switch (outcome) {
    case ViewOutcome::kNew:
      return "new";
    case ViewOutcome::kMerged:
      return "merged";
    case ViewOutcome::kSeenAgain:
      return "seen again";
    case ViewOutcome::kRestarted:
      return "restarted";
    case ViewOutcome::kOutlier:
      return "outlier";
    case ViewOutcome::kRefused:
      return "refused";
  }
  return "unknown";
}

}  // namespace monocular_eye_hand
