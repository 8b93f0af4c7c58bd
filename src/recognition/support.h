#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/model/object_model.h"
#include "monocular_eye_hand/pose/matches.h"
#include "monocular_eye_hand/recognition/object_estimate.h"
#include "recognition/support_evidence.h"

namespace monocular_eye_hand {

/// The directions in the object frame that point up when the part rests by itself; none for a part that has
/// no volume.
std::vector<Eigen::Vector3d> directionsUpAtRest(const ObjectModel& model);

/// A plane that parts stand on, and how each part of the model base can stand.
struct Support {
  SupportPlane plane;
  std::vector<std::vector<Eigen::Vector3d>> up_at_rest;  ///< per object: directionsUpAtRest()
  double rest_log_odds = 0;                              ///< RecognitionOptions::rest_log_odds
};

/// What the plane says of a pose. A pose may seem to reach below it by the plane's tolerance and three sigmas
/// of its own height. That a part does not rest on it says nothing: parts lie on parts.
SupportEvidence evidenceOfSupport(const Support& support, int object, const ObjectModel& model,
                                  const RefinedPose& pose);

}  // namespace monocular_eye_hand
