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

/// polygonBreaks() of whole traces, kept by findArcs for findSegments.
class TracePolygons {
 public:
  void add(int trace, const std::vector<int>& breaks) {
    places_.push_back({trace, int(breaks_.size()), int(breaks.size())});
    breaks_.insert(breaks_.end(), breaks.begin(), breaks.end());
  }
  /// Moves the breaks of a trace into `breaks`; traces have to be asked for in the order they were added in.
  bool take(int trace, std::vector<int>* breaks) {
    while (next_ < places_.size() && places_[next_].trace < trace) ++next_;
    if (next_ == places_.size() || places_[next_].trace != trace) return false;
    const auto from = breaks_.begin() + places_[next_].first;
    breaks->assign(from, from + places_[next_].count);
    return true;
  }

 private:
  struct Place {
    int trace, first, count;
  };
  std::vector<Place> places_;
  std::vector<int> breaks_;
  size_t next_ = 0;
};

/// Joins neighbouring pieces that one line explains.
void mergeBreaks(const std::vector<EdgePoint>& points, const LineSums& sums, double correlation_length,
                 double tolerance, std::vector<int>* breaks);

/// Tolerance for splitting a run: a few standard deviations of its points, between 0.4 px and the option.
double splitTolerance(const std::vector<EdgePoint>& points, PointRange range, const FeatureOptions& options);

/// Tolerance for joining pieces again: the option, more where noise lets neighbouring points wander farther
/// together.
double mergeTolerance(const std::vector<EdgePoint>& points, PointRange range, const FeatureOptions& options);

/// Turns closed traces so that they start at a corner if they have one.
void rotateClosedTraces(LinkedEdges* edges);

/// Curved pieces of all traces: runs of polygon pieces that turn the same way and that an ellipse explains
/// better than the lines do (minimum description length).
std::vector<EllipticArc> findArcs(const LinkedEdges& edges, double correlation_length,
                                  const FeatureOptions& options, TracePolygons* polygons);

/// Straight pieces of the traces outside `taken` (ranges of points that belong to ellipses, ascending).
std::vector<LineSegment> findSegments(const LinkedEdges& edges, const std::vector<PointRange>& taken,
                                      double correlation_length, const FeatureOptions& options,
                                      TracePolygons* polygons);

}  // namespace monocular_eye_hand
