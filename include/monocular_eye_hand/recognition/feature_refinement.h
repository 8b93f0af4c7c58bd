#pragma once
#include <vector>

#include "monocular_eye_hand/pose/refine.h"

namespace monocular_eye_hand {

/// Refines a pose on contour samples whose errors are not independent: what displaces an edge in the image (a
/// shadow, a chamfer, a neighbour taken for it) displaces all of it. The samples of a feature (equal entries
/// of `groups`) share an error of offset and one of slope, whose size is the feature's own, beside
/// independent ones. Sizes and pose are estimated together by expectation maximisation (Dempster, Laird,
/// Rubin 1977, 4.4), so that a feature that does not agree with the others counts little. One linearisation:
/// `start` has to be within a pixel or two. The covariance is that of the pose given the sizes, widened with
/// the residuals' spread; what the samples leave open has the variance of a weak prior (1 m, 1.8 rad), about
/// a free axis it is pi^2 / 3. `well_posed` is false, and the pose `start`, when no finite sample lies within
/// 1.5 px.
RefinedPose refineByFeatures(const Rigid3& start, const Camera& camera, const std::vector<LineMatch>& matches,
                             const std::vector<int>& groups, const FreeAxis& axis);

}  // namespace monocular_eye_hand
