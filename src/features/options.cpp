#include <cmath>

#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {

void FeatureOptions::check() const {
  FeatureOptions fields = *this;  // visit() is not const
  fields.visit([](const char* field, double value) { requireFinite(field, value); });
  require(smoothing_sigma >= 0.4 && smoothing_sigma <= 2.6, "smoothing_sigma", smoothing_sigma,
          "within 0.4 .. 2.6 px");
  requirePositive("gradient_threshold", gradient_threshold);
  requireNotNegative("noise_factor", noise_factor);
  require(min_trace_points >= 4, "min_trace_points", min_trace_points, "at least 4");
  require(min_segment_length >= 3, "min_segment_length", min_segment_length, "at least 3 px");
  require(split_tolerance >= 0.4, "split_tolerance", split_tolerance, "at least 0.4 px");
  require(join_gap_ratio >= 0 && join_gap_ratio < 1, "join_gap_ratio", join_gap_ratio, "within 0 .. 1");
  require(min_arc_sweep > 0 && min_arc_sweep < 6.28, "min_arc_sweep", min_arc_sweep, "within 0 .. 2 pi");
  require(min_ellipse_axis >= 1, "min_ellipse_axis", min_ellipse_axis, "at least 1 px");
  require(min_ellipse_coverage > 0 && min_ellipse_coverage <= 1, "min_ellipse_coverage", min_ellipse_coverage,
          "within 0 .. 1");
}

}  // namespace monocular_eye_hand
