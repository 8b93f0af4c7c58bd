#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/model/characteristic_views.h"

namespace monocular_eye_hand {

/// A sampled view's contour on the plane through the object's centre: where the camera's axis meets it lies
/// the origin, and lengths there are metres at the centre's distance.
struct FlatView {
  std::vector<Eigen::Vector2d> place;      ///< one per contour sample of the view [m]
  std::vector<Eigen::Vector2d> direction;  ///< of the contour there, as long as a metre along it looks
  std::vector<int> feature;                ///< ContourSample::feature
  double length = 0;                       ///< of the whole contour [m]
};

/// `rotation`: rows are the camera's axes in the object frame; `centre`: the object's [m]; `step`: between
/// neighbouring samples [m].
FlatView flatten(const SampledView& view, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& centre,
                 double step);

/// A point of the object on the plane.
Eigen::Vector2d flatPoint(const Eigen::Vector3d& p_in_object, const SampledView& view,
                          const Eigen::Matrix3d& rotation, const Eigen::Vector3d& centre);

/// Median distance between neighbouring samples of the same feature [m].
double sampleStepOf(const SampledView& view);

/// Farthest-first order of `count` places: every prefix is spread out. `nearest`: how far each is from what
/// there is already; the farthest comes first.
std::vector<int> spreadOrder(const std::vector<Eigen::Vector2d>& places, std::vector<double> nearest,
                             int count);

}  // namespace monocular_eye_hand
