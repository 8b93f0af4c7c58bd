#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "recognition/drawing_terms.h"
#include "recognition/focal_length.h"

namespace monocular_eye_hand {

void viewTerms(const SearchModel& model, const SearchImage& image, Candidate* candidate) {
  const Rigid3& pose = candidate->pose.camera_from_object;
  const ViewExtent seen = model.extentSeenFrom(pose);
  const ViewExtent& largest = model.largestExtent();
  EvidenceTerms& terms = candidate->terms;
  terms.view_area = largest.area > 0 ? std::min(1.0, seen.area / largest.area) : 1;
  terms.extent = model.model().diameter > 0 ? std::min(1.0, seen.length / model.model().diameter) : 1;
  terms.complexity = std::log(std::max(1.0, terms.contour_length) / std::max(1.0, terms.size));
  const double distance = (pose * model.model().centre()).norm();
  terms.diameter = model.model().diameter / distance * focalLength(image.camera);
}

}  // namespace monocular_eye_hand
