#include "grouping/weights.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

constexpr double kTypicalGap = 2.5;    // [px]
constexpr double kWeakContrast = 3.0;  // [grey levels per px] as likely noise or shadow as an edge
constexpr double kShortLength = 8.0;   // [px] as likely an accident as an edge, in an empty neighbourhood
constexpr double kThinCoverage = 0.2;  // share of the circumference: as likely a bent contour as an ellipse
constexpr double kLooseRms = 1.0;      // [px] point-to-ellipse distance: same
constexpr double kSmallAxis = 3.0;     // [px] same

}  // namespace

double clampWeight(double probability) { return std::clamp(probability, 1e-4, 1.0 - 1e-4); }

double cornerWeight(double gap, double end_density) {
  const double structure = std::exp(-gap / kTypicalGap) / kTypicalGap;
  const double accident = 2.0 * M_PI * end_density * std::max(gap, 1.0);
  return clampWeight(structure / (structure + accident));
}

double segmentWeight(const LineSegment& segment, double end_density) {
  const double length = segment.length();
  const double crowd = end_density * M_PI * kShortLength * kShortLength;
  return clampWeight(segment.contrast / (segment.contrast + kWeakContrast) * length /
                     (length + kShortLength * (1.0 + crowd)));
}

double endWeight(EndState state) {
  switch (state) {
    case EndState::kCorner:
      return 0.9;
    case EndState::kFree:
      return 0.6;
    case EndState::kStem:
      return 0.3;
    case EndState::kContinued:
      return 0.2;
    case EndState::kBorder:
      return 0.1;
  }
  return 0.1;
}

double closedWeight(double probability) { return 1.0 - (1.0 - probability) * (1.0 - probability); }

double ellipseWeight(const DetectedEllipse& e) {
  const double looseness = e.rms / kLooseRms;
  return clampWeight(e.coverage / (e.coverage + kThinCoverage) / (1.0 + looseness * looseness) * e.ellipse.b /
                     (e.ellipse.b + kSmallAxis));
}

}  // namespace monocular_eye_hand
