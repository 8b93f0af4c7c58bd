#include <cmath>
#include <sstream>

#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

void require(bool ok, const char* field, double value, const char* rule) {
  if (ok) return;
  std::ostringstream text;
  text << "features: " << field << " = " << value << " " << rule;
  throw BadInput(text.str());
}

}  // namespace

void FeatureOptions::check() const {
  FeatureOptions fields = *this;  // visit() is not const
  fields.visit(
      [](const char* field, double value) { require(std::isfinite(value), field, value, "is not finite"); });
  require(smoothing_sigma >= 0.4 && smoothing_sigma <= 2.6, "smoothing_sigma", smoothing_sigma,
          "must lie in 0.4 .. 2.6 px");
  require(gradient_threshold > 0, "gradient_threshold", gradient_threshold, "must be positive");
  require(noise_factor >= 0, "noise_factor", noise_factor, "must not be negative");
  require(min_trace_points >= 4, "min_trace_points", min_trace_points, "must be at least 4");
  require(min_segment_length >= 3, "min_segment_length", min_segment_length, "must be at least 3 px");
  require(split_tolerance >= 0.4, "split_tolerance", split_tolerance, "must be at least 0.4 px");
  require(join_gap_ratio >= 0 && join_gap_ratio < 1, "join_gap_ratio", join_gap_ratio, "must lie in 0 .. 1");
  require(min_arc_sweep > 0 && min_arc_sweep < 6.28, "min_arc_sweep", min_arc_sweep, "must lie in 0 .. 2 pi");
  require(min_ellipse_axis >= 1, "min_ellipse_axis", min_ellipse_axis, "must be at least 1 px");
  require(min_ellipse_coverage > 0 && min_ellipse_coverage <= 1, "min_ellipse_coverage", min_ellipse_coverage,
          "must lie in 0 .. 1");
}

}  // namespace monocular_eye_hand
