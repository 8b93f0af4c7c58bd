#pragma once
#include <memory>
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// Groups arcs that lie on one ellipse (same polarity, within the uncertainty of the group's ellipse), fits
/// each group and keeps the ellipses whose coverage, residuals and uncertainty make them believable.
class ArcJoiner {
 public:
  explicit ArcJoiner(const FeatureOptions& options);
  ~ArcJoiner();
  /// `ellipse_arcs` becomes what FeatureSet says.
  void join(const std::vector<EdgePoint>& points, const std::vector<EllipticArc>& arcs,
            double correlation_length, std::vector<DetectedEllipse>* ellipses,
            std::vector<int>* ellipse_arcs);

 private:
  class Joining;
  std::unique_ptr<Joining> joining_;
};

/// Adds segments that join collinear plain segments across gaps, longest chains first found along each line.
class SegmentJoiner {
 public:
  explicit SegmentJoiner(const FeatureOptions& options);
  ~SegmentJoiner();
  /// `segments` holds plain ones before; `joined_pieces` becomes what FeatureSet says.
  void join(std::vector<LineSegment>* segments, std::vector<int>* joined_pieces);

 private:
  class Joining;
  std::unique_ptr<Joining> joining_;
};

}  // namespace monocular_eye_hand
