#pragma once
#include <vector>

#include "monocular_eye_hand/features/features.h"

namespace monocular_eye_hand {

/// Groups arcs that lie on one ellipse (same polarity, within the uncertainty of the group's ellipse), fits
/// each group and keeps the ellipses whose coverage, residuals and uncertainty make them believable.
std::vector<DetectedEllipse> joinArcs(const std::vector<EdgePoint>& points,
                                      const std::vector<EllipticArc>& arcs, double correlation_length,
                                      const FeatureOptions& options);

/// Segments that join collinear plain segments across gaps, longest chains first found along each line.
std::vector<LineSegment> joinSegments(const std::vector<LineSegment>& plain, const FeatureOptions& options);

}  // namespace monocular_eye_hand
