#pragma once
#include <optional>
#include <vector>

#include "monocular_eye_hand/pose/matches.h"
#include "recognition/candidate.h"
#include "recognition/search_image.h"
#include "recognition/search_model.h"

namespace monocular_eye_hand {

/// Ranges within which a coarse alignment seeks edge points, round after round [px]: all hypotheses first by
/// the wide ones, then the best of them by the narrow ones.
inline const std::vector<double> kWideRanges{10, 8}, kNarrowRanges{6, 4, 3};
/// Ranges within which the fine alignment of a hypothesis seeks edge points, round after round [px].
inline const std::vector<double> kFineRanges{6.0, 4.0, 2.5, 1.5};
/// Distance between the contour samples of a fine alignment [px].
constexpr double kFineStep = 4.0;

/// Projects the exact visible contour at about `step` px.
std::vector<SeenSample> projectContour(const ObjectModel& model, const Rigid3& camera_from_object,
                                       const Camera& camera, const RectDomain& domain, double step);

/// A pose and the sampled view (ViewSphere::views) nearest to it.
struct ViewedPose {
  Rigid3 camera_from_object;
  int view = 0;
};

/// Moves a hypothesis onto the edges within `ranges` [px] with the precomputed contour of its nearest view:
/// cheap, wide basin. The view follows the pose. Nothing when the pose escapes or too little of it is
/// answered.
std::optional<ViewedPose> alignCoarsely(const SearchModel& model, const SearchImage& image, ViewedPose start,
                                        const std::vector<double>& ranges);

/// Refines on the exact visible contour, hidden lines removed, re-associated with shrinking range [px];
/// `step`: distance between contour samples [px].
RefinedPose alignFinely(const SearchModel& model, const SearchImage& image, const Rigid3& start,
                        const std::vector<double>& ranges, double step);

/// The last step: the features weighed against each other (refineByFeatures) at samples within `range` px of
/// the contour under `start`, an aligned pose; then once more at the samples sought again. `well_posed` is
/// false, and the pose `start`, when too little of the contour is answered.
RefinedPose alignByFeatures(const SearchModel& model, const SearchImage& image, const Rigid3& start,
                            double range, double step);

}  // namespace monocular_eye_hand
