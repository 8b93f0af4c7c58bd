
#include "monocular_eye_hand/eye_hand/object_map_options.h"
#include "monocular_eye_hand/eye_hand/object_view.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void ObjectMapOptions::check() const {
  arm.check();
  hand_eye.check();

  requireShare("min_probability", min_probability);
  require(doubtful_probability >= 0 && doubtful_probability <= min_probability, "doubtful_probability",
          doubtful_probability, "0 to min_probability");
  require(agreement_odds >= 1, "agreement_odds", agreement_odds, "1 or more");
  requirePositive("floor_position", floor_position);
  requirePositive("floor_rotation", floor_rotation);
  requirePositive("gate", gate);
  requirePositive("same_place", same_place);
  requireNotNegative("max_distance", max_distance);

  require(outliers_to_restart >= 1, "outliers_to_restart", outliers_to_restart, "1 or more");
  requireNotNegative("min_motion", min_motion);
  requireNotNegative("min_rotation", min_rotation);
  require(max_views >= 1, "max_views", max_views, "1 or more");
  requirePositive("overlap_depth", overlap_depth);
  requireNotNegative("known_depth", known_depth);
  requireNotNegative("known_sigmas", known_sigmas);
  require(forget_after_misses >= 1, "forget_after_misses", forget_after_misses, "1 or more");

  requireShare("expected_share", expected_share);
  requireNotNegative("expected_size", expected_size);
  requireNotNegative("expected_border", expected_border);
  requireNotNegative("expected_nearest", expected_nearest);
  require(expected_farthest > expected_nearest, "expected_farthest", expected_farthest,
          "above expected_nearest");
}

}  // namespace monocular_eye_hand
