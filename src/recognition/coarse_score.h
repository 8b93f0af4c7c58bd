#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "recognition/evidence.h"

namespace monocular_eye_hand {

/// One contour sample of a sampled view, in single precision.
struct ViewSample {
  Eigen::Vector3f p, tangent;  ///< object frame; tangent unit
  int feature = 0;
};

/// The contour of a view as the coarse score reads it: every coordinate of the samples in a row, filled up to
/// whole batches with samples of no length.
struct CoarseContour {
  static constexpr int kMaxSamples = 64;  ///< samples
  static constexpr int kBatch = 8;        ///< samples looked at together
  /// `samples`: at most kMaxSamples, ordered so that every prefix is spread over the contour; `step`: between
  /// neighbours [m].
  CoarseContour(const std::vector<ViewSample>& samples, float step);

  using Row = std::array<float, kMaxSamples>;
  std::array<Row, 3> p, tangent;  ///< object frame [m]; tangent: unit, of a sample that fills up 0
  int count = 0;                  ///< with those that fill up
  float step = 0;                 ///< [m]
};

/// Coarse plausibility of a pose: evidence summed along a view's contour.
struct CoarseScore {
  float evidence = 0;  ///< nats, one independent sample per 5 px of contour
  float in_frame = 0;  ///< share of the contour inside the image
};
/// `contour`: of the view nearest to the pose. Stops early and returns a very low score when the first
/// samples are hopeless.
CoarseScore scorePose(const CoarseContour& contour, const Rigid3& camera_from_object, const Camera& camera,
                      const EvidenceMap& map);

}  // namespace monocular_eye_hand
