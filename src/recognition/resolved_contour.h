#pragma once
#include <vector>

#include "monocular_eye_hand/model/object_model.h"
#include "recognition/candidate.h"

namespace monocular_eye_hand {

/// Angle between the faces that meet at a feature (SeenSample::feature) [rad]; 0 of a silhouette of no edge.
double dihedralOf(const ObjectModel& model, int feature);

/// What of a drawn contour a camera can tell apart: of parallel lines of different features that run less
/// than 2.5 px beside each other (the rims of a chamfer, of a sheet, of a fillet seen from afar) only the
/// most telling one is kept, sample by sample: an outline before a crease, a sharp crease before a blunt one.
/// The indices of those kept, ascending.
std::vector<size_t> resolvedSamples(const ObjectModel& model, const std::vector<SeenSample>& contour);
/// The same as a contour.
std::vector<SeenSample> resolvedContour(const ObjectModel& model, const std::vector<SeenSample>& contour);

/// A flag per sample: it belongs to a circle between others, as a ring of a thread, with two lines and more
/// on either side within 10 px. The light decides whether an image shows such rings or none of them.
std::vector<char> crowdedRings(const ObjectModel& model, const std::vector<SeenSample>& contour);

}  // namespace monocular_eye_hand
