#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/pose/feature_refinement.h"

namespace monocular_eye_hand {

/// A place of a contour in the image.
struct ContourPlace {
  Eigen::Vector2d uv;      ///< [px]
  Eigen::Vector2d normal;  ///< unit
  int feature = 0;         ///< places with the same number lie on one curve
};
/// Signed curvature of the contour at each place [1/px], positive where the centre lies on the normal's side:
/// a parabola through the places of the same curve within a few pixels. 0 where there are too few.
std::vector<double> curvatures(const std::vector<ContourPlace>& contour);

/// Blur moves the steepest point of a bent edge towards the centre of its bend, by blur^2 / (2 radius), most
/// of all where holes are small: all circles look smaller and the object farther away. Moves the pixels that
/// answer the samples back by that, as the contour bends under `pose`.
void correctBlurBias(const Rigid3& pose, const Camera& camera, std::vector<FeatureSample>* samples);

}  // namespace monocular_eye_hand
