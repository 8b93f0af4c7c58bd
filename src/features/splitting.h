#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "features/ellipse_fitting.h"
#include "features/line_fitting.h"
#include "features/linking.h"

namespace monocular_eye_hand {

/// Approximates runs of points by polygons; the breaks of one are the first index of each piece and, last,
/// the end.
class PolygonSplitter {
 public:
  /// Breaks a run of points into pieces that stay within `tolerance` [px] of their chord (Ramer 1972), then
  /// moves every break to where the two lines beside it fit best.
  void split(const std::vector<EdgePoint>& points, const LineSums& sums, PointRange range, double tolerance,
             std::vector<int>* breaks);
  /// Joins neighbouring pieces that one line explains.
  void merge(const std::vector<EdgePoint>& points, const LineSums& sums, double correlation_length,
             double tolerance, std::vector<int>* breaks);

 private:
  std::vector<std::pair<int, int>> todo_;  // first and last point of runs not yet looked at
  std::vector<char> moved_;                // per break
  std::vector<double> gains_;              // per break
};

/// Polygons of whole traces, kept by ArcFinder for SegmentFinder.
class TracePolygons {
 public:
  void clear() {
    places_.clear();
    breaks_.clear();
    next_ = 0;
  }
  void add(int trace, const std::vector<int>& breaks) {
    places_.push_back({trace, int(breaks_.size()), int(breaks.size())});
    breaks_.insert(breaks_.end(), breaks.begin(), breaks.end());
  }
  /// Writes the breaks of a trace into `breaks`; traces have to be asked for in the order they were added in.
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

/// Tolerance for splitting a run: a few standard deviations of its points, between 0.4 px and the option.
double splitTolerance(const std::vector<EdgePoint>& points, PointRange range, const FeatureOptions& options);

/// Tolerance for joining pieces again: the option, more where noise lets neighbouring points wander farther
/// together.
double mergeTolerance(const std::vector<EdgePoint>& points, PointRange range, const FeatureOptions& options);

/// Turns closed traces so that they start at a corner if they have one.
void rotateClosedTraces(LinkedEdges* edges);

/// Curved pieces of all traces: runs of polygon pieces that turn the same way and that an ellipse explains
/// better than the lines do (minimum description length).
class ArcFinder {
 public:
  explicit ArcFinder(const FeatureOptions& options);
  ~ArcFinder();
  void find(const LinkedEdges& edges, double correlation_length, TracePolygons* polygons,
            std::vector<EllipticArc>* out);

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

/// Straight pieces of the traces outside `taken` (ranges of points that belong to ellipses, ascending).
class SegmentFinder {
 public:
  explicit SegmentFinder(const FeatureOptions& options);
  ~SegmentFinder();
  void find(const LinkedEdges& edges, const std::vector<PointRange>& taken, double correlation_length,
            TracePolygons* polygons, std::vector<LineSegment>* out);

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace monocular_eye_hand
