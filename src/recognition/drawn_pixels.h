#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "monocular_eye_hand/model/object_model.h"
#include "recognition/candidate.h"
#include "recognition/search_image.h"

namespace monocular_eye_hand {

/// A pixel of the lattice that a candidate's part covers.
struct DrawnPixel {
  int u, v;
  int triangle;
  double distance;  ///< from the camera [m]
};

/// Lattice step with which at most `max_rays` pixels of the box are looked at: 2, 4 ... kCoverCell px.
int latticeStep(const cv::Rect& box, int max_rays);

/// Those of the lattice within the candidate's bounding box, row by row. The lattice is common to all
/// candidates of an image, so that their pixels compare.
std::vector<DrawnPixel> drawnPixels(const ObjectModel& model, const SearchImage& image,
                                    const Candidate& candidate, int step);

/// Those that no surely recognised object hides.
std::vector<DrawnPixel> unhidden(std::vector<DrawnPixel> pixels, const SearchImage& image,
                                 const Candidate& candidate);

/// Which way the drawn face looks: outward, unit, camera frame.
Eigen::Vector3f normalInCamera(const ObjectModel& model, const Candidate& candidate, const DrawnPixel& pixel);

}  // namespace monocular_eye_hand
