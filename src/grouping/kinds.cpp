#include <cmath>
#include <sstream>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/grouping/grouping.h"

namespace monocular_eye_hand {

std::string toString(GroupingKind kind) {
  switch (kind) {
    case GroupingKind::kEdge:
      return "edge";
    case GroupingKind::kJunction:
      return "junction";
    case GroupingKind::kTriplet:
      return "triplet";
    case GroupingKind::kChain:
      return "chain";
    case GroupingKind::kQuad:
      return "quad";
    case GroupingKind::kParallelPair:
      return "parallel_pair";
    case GroupingKind::kEllipse:
      return "ellipse";
    case GroupingKind::kEllipsePair:
      return "ellipse_pair";
    case GroupingKind::kEllipseLine:
      return "ellipse_line";
  }
  return "unknown";
}

std::string toString(GroupingShape shape) {
  switch (shape) {
    case GroupingShape::kNone:
      return "none";
    case GroupingShape::kArrow:
      return "arrow";
    case GroupingShape::kY:
      return "Y";
    case GroupingShape::kT:
      return "T";
    case GroupingShape::kU:
      return "U";
    case GroupingShape::kZ:
      return "Z";
    case GroupingShape::kClosed:
      return "closed";
    case GroupingShape::kOpen:
      return "open";
  }
  return "unknown";
}

namespace {

void require(bool holds, const char* field, double value, const char* rule) {
  if (holds) return;
  std::ostringstream text;
  text << "GroupingOptions::" << field << " = " << value << ": " << rule;
  throw BadInput(text.str());
}

}  // namespace

void GroupingOptions::check() const {
  require(corner_gap > 0 && corner_gap <= 100, "corner_gap", corner_gap, "must be in (0, 100] px");
  require(corner_gap_ratio > 0 && corner_gap_ratio < 0.5, "corner_gap_ratio", corner_gap_ratio,
          "must be in (0, 0.5): beyond half a segment its two ends could not be told apart");
  require(min_corner_angle > 0 && min_corner_angle < 1.5, "min_corner_angle", min_corner_angle,
          "must be in (0, 1.5) rad");
  require(max_corners_per_end >= 1, "max_corners_per_end", max_corners_per_end, "must be at least 1");

  require(parallel_angle > 0 && parallel_angle < 0.8, "parallel_angle", parallel_angle,
          "must be in (0, 0.8) rad");
  require(parallel_overlap > 0 && parallel_overlap <= 1, "parallel_overlap", parallel_overlap,
          "must be in (0, 1]");
  require(parallel_distance_ratio > 0 && std::isfinite(parallel_distance_ratio), "parallel_distance_ratio",
          parallel_distance_ratio, "must be positive");
  require(max_pairs_per_feature >= 1, "max_pairs_per_feature", max_pairs_per_feature, "must be at least 1");

  require(ellipse_axis_tolerance > 0 && ellipse_axis_tolerance < 1, "ellipse_axis_tolerance",
          ellipse_axis_tolerance, "must be in (0, 1)");
  require(ellipse_reach >= 1 && std::isfinite(ellipse_reach), "ellipse_reach", ellipse_reach,
          "must be at least 1");

  require(border_margin >= 0 && std::isfinite(border_margin), "border_margin", border_margin,
          "must not be negative");
  require(free_end_sigma > 0 && free_end_sigma < kCutOffSigma, "free_end_sigma", free_end_sigma,
          "must be positive and below the 20 px that mean a cut-off end");
  require(max_per_kind >= 1, "max_per_kind", max_per_kind, "must be at least 1");
}

}  // namespace monocular_eye_hand
