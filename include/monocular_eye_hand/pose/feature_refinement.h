#pragma once
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/pose/edge_profile.h"
#include "monocular_eye_hand/pose/matches.h"

namespace monocular_eye_hand {

/// A contour sample and the edge point that answers it.
struct FeatureSample {
  LineMatch line;   ///< its sigma is not looked at
  int feature = 0;  ///< samples with the same number belong to one model feature
  EdgeAppearance appearance;
  double displacement = 0;  ///< standard deviation of its edge's place, beside what its appearance tells [px]
};

/// Refines a pose on contour samples whose errors are not independent: what displaces an edge in the image (a
/// shadow, a chamfer, a neighbour taken for it) displaces all of it. The samples of a feature share an error
/// of offset and one of slope beside independent ones. How large they are is guessed from the appearance of
/// the feature's edge (EdgeProfiles), then estimated together with the pose by expectation maximisation
/// (Dempster, Laird, Rubin 1977, 4.4), so that a feature that does not agree with the others counts little;
/// once more with larger guesses where the residuals spread farther than of a true model.
/// One linearisation: `start` has to be within a pixel or two. The covariance is that of the pose given the
/// sizes, in proportion to the residuals' spread, and of a shift common to all features; what the samples
/// leave open has the variance of a weak prior (1 m, 1.8 rad), about a free axis it is pi^2 / 3. `well_posed`
/// is false, and the pose `start`, when no finite sample lies within 1.5 px.
RefinedPose refineByFeatures(const Rigid3& start, const Camera& camera,
                             const std::vector<FeatureSample>& samples, const FreeAxis& axis);

}  // namespace monocular_eye_hand
