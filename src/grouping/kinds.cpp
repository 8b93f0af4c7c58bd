#include <cmath>

#include "monocular_eye_hand/geometry/require.h"
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

void GroupingOptions::check() const {
  require(corner_gap > 0 && corner_gap <= 100, "corner_gap", corner_gap, "in (0, 100] px");
  require(corner_gap_ratio > 0 && corner_gap_ratio < 0.5, "corner_gap_ratio", corner_gap_ratio,
          "in (0, 0.5): beyond half a segment its two ends could not be told apart");
  require(min_corner_angle > 0 && min_corner_angle < 1.5, "min_corner_angle", min_corner_angle,
          "in (0, 1.5) rad");
  require(max_corners_per_end >= 1, "max_corners_per_end", max_corners_per_end, "at least 1");

  require(parallel_angle > 0 && parallel_angle < 0.8, "parallel_angle", parallel_angle, "in (0, 0.8) rad");
  require(parallel_overlap > 0 && parallel_overlap <= 1, "parallel_overlap", parallel_overlap, "in (0, 1]");
  requirePositive("parallel_distance_ratio", parallel_distance_ratio);
  require(max_pairs_per_feature >= 1, "max_pairs_per_feature", max_pairs_per_feature, "at least 1");

  require(ellipse_axis_tolerance > 0 && ellipse_axis_tolerance < 1, "ellipse_axis_tolerance",
          ellipse_axis_tolerance, "in (0, 1)");
  require(ellipse_reach >= 1 && std::isfinite(ellipse_reach), "ellipse_reach", ellipse_reach, "at least 1");

  require(border_margin >= 0 && std::isfinite(border_margin), "border_margin", border_margin, "0 or more");
  require(free_end_sigma > 0 && free_end_sigma < kCutOffSigma, "free_end_sigma", free_end_sigma,
          "positive and below the 20 px that mean a cut-off end");
  require(max_per_kind >= 1, "max_per_kind", max_per_kind, "at least 1");
}

}  // namespace monocular_eye_hand
