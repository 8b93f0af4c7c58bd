#pragma once
#include <vector>

#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// The visible contour seen from `eye_in_object` (perspective): sharp edges and circles that are not hidden,
/// and the silhouette lines of curved surfaces. Samples are about `step` metres apart along every feature, at
/// least one per visible feature, in order along the feature. Edges whose two surfaces both face away are
/// left out; so are interior creases flatter than `min_dihedral` [rad]. Visibility rays start slightly
/// outside the surface so that an edge does not hide itself. Throws BadInput on a bad option or a model that
/// buildModel did not make.
struct ContourOptions {
  double step = 0.005;         ///< [m]
  double min_dihedral = 0.26;  ///< [rad]
  void check() const;
};
std::vector<ContourSample> visibleContour(const ObjectModel& model, const Eigen::Vector3d& eye_in_object,
                                          const ContourOptions& options);

}  // namespace monocular_eye_hand
