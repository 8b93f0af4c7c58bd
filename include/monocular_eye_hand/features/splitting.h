#pragma once
#include <vector>

#include "monocular_eye_hand/features/ellipse_fitting.h"
#include "monocular_eye_hand/features/line_fitting.h"
#include "monocular_eye_hand/features/linking.h"

namespace monocular_eye_hand {

/// Breaks a run of points into pieces that stay within `tolerance` of their chord (Ramer 1972), then moves
/// every break to where the two lines beside it fit best. Returns the first index of each piece and, last,
/// the end.
std::vector<int> polygonBreaks(const std::vector<EdgePoint>& points, const LineSums& sums, PointRange range,
                               double tolerance);

/// Joins neighbouring pieces that one line explains.
void mergeBreaks(const std::vector<EdgePoint>& points, const LineSums& sums, double correlation_length,
                 double tolerance, std::vector<int>* breaks);

/// Tolerance for splitting a run: a few standard deviations of its points, between 0.4 px and the option.
double splitTolerance(const std::vector<EdgePoint>& points, PointRange range, const FeatureOptions& options);

/// Turns closed traces so that they start at a corner if they have one.
void rotateClosedTraces(LinkedEdges* edges);

/// Curved pieces of all traces: runs of polygon pieces that turn the same way and that an ellipse explains
/// better than the lines do (minimum description length).
std::vector<EllipticArc> findArcs(const LinkedEdges& edges, double correlation_length,
                                  const FeatureOptions& options);

/// Straight pieces of the traces outside `taken` (ranges of points that belong to ellipses, ascending).
std::vector<LineSegment> findSegments(const LinkedEdges& edges, const std::vector<PointRange>& taken,
                                      double correlation_length, const FeatureOptions& options);

}  // namespace monocular_eye_hand
