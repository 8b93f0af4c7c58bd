#pragma once
#include "grouping/ends.h"
#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

// The weight of a grouping is the probability that it is the structure of one object and no accident.
//
// Corner. Two ends that lie g pixels from the lines' intersection. When they belong to one corner, g is
// exponential with mean kTypicalGap (smoothing and thinning keep edges a little short of a corner). When they
// do not, ends lie about with the local density rho [1/px^2] and the nearest is at g with density 2 pi rho g.
// Bayes with even odds:
//   odds = exp(-g / kTypicalGap) / kTypicalGap / (2 pi rho max(g, 1)),   P = odds / (1 + odds).
//
// Segment. P(real) = c / (c + kWeakContrast) * L / (L + kShortLength (1 + n)), c its contrast, L its length,
// n the number of ends expected by accident within kShortLength of it: among dense texture only long lines
// stand out.
//
// Groupings of several features multiply what must hold together. A figure that closes on itself (triplet,
// quad) is confirmed a second time by every feature: P_closed = 1 - (1 - P)^2.

/// Keeps a probability off the certain ends.
double clampWeight(double probability);
double cornerWeight(double gap, double end_density);
double segmentWeight(const LineSegment& segment, double end_density);
/// How likely an end in this state is the true end of an edge.
double endWeight(EndState state);
double closedWeight(double probability);
double ellipseWeight(const DetectedEllipse& ellipse);

}  // namespace monocular_eye_hand
