#pragma once
#include <vector>

#include "monocular_eye_hand/pose/refine.h"
#include "recognition/candidate.h"
#include "recognition/evidence.h"
#include "recognition/search_model.h"

namespace monocular_eye_hand {

/// Projects the exact visible contour at about `step` px.
std::vector<SeenSample> projectContour(const ObjectModel& model, const Rigid3& camera_from_object,
                                       const Camera& camera, const RectDomain& domain, double step);

/// Moves a hypothesis onto the edges with the precomputed contour of its nearest view: cheap, wide basin.
/// *view follows the pose. False when the pose escapes or too little of it is answered.
bool alignCoarsely(const SearchModel& model, const Camera& camera, const EdgeRaster& raster, Rigid3* pose,
                   int* view);

/// Refines on the exact visible contour, hidden lines removed, re-associated with shrinking range.
RefinedPose alignFinely(const SearchModel& model, const Camera& camera, const RectDomain& domain,
                        const EdgeRaster& raster, const Rigid3& start, const std::vector<double>& ranges,
                        double step);

/// The last step: the features weighed against each other (refineByFeatures) at samples within `range` px of
/// the contour under `start`, an aligned pose; then once more at the samples sought again. `well_posed` is
/// false, and the pose `start`, when too little of the contour is answered.
RefinedPose alignByFeatures(const SearchModel& model, const Camera& camera, const RectDomain& domain,
                            const EdgeRaster& raster, const Rigid3& start, double range, double step);

}  // namespace monocular_eye_hand
